"""Outcome of the checks of a facade in a few words, for its page and its figure."""

from rocksteady.facades.checks.facade_check import FacadeCheck
from rocksteady.facades.plots.languages import Language

LOOKS = {
    True: ("satisfied", "green"),
    False: ("not_satisfied", "red"),
    None: ("no_verdict", "open"),
}
"""Words and look of each outcome of a check."""


def headline_of(check: FacadeCheck, words: Language) -> str:
    """Return how many checks hold; empty where there is one sentence alone."""
    decided = [each.satisfied for each in check.checks if each.satisfied is not None]
    failed = decided.count(False)
    if len(decided) < 2:
        return ""
    if failed in (0, len(decided)):
        return words["headline_no" if failed else "headline_all"]
    return words(
        "headline_one" if failed == 1 else "headline_some", failed=failed, all=len(decided)
    )


def verdict_of(check: FacadeCheck, words: Language) -> dict[str, str]:
    """Return word and look of the badge at the top."""
    decided = [each.satisfied for each in check.checks if each.satisfied is not None]
    if not decided:
        return {"word": words["no_verdict"], "look": "open"}
    for state in check.states:
        if check.decided(state, True) and check.decided(state, False):
            return {"word": words["differ"], "look": "amber"}
    word, look = LOOKS[all(decided)]
    return {"word": words[word], "look": look}


def title_of(check: FacadeCheck, words: Language) -> str:
    """Return the name of the facade and the outcome of its checks."""
    outcome = headline_of(check, words).rstrip(".") or verdict_of(check, words)["word"]
    return f"{check.facade.name}: {outcome[:1].lower()}{outcome[1:]}"
