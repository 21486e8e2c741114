"""Words of proofs: certificates, proved regions, and certificates that were checked."""

from rocksteady.certify.proofs.certificate import Certificate, meaning
from rocksteady.certify.proofs.files import SAMPLED, CheckedCertificate
from rocksteady.certify.proofs.region import SPLIT, ProvedRegion
from rocksteady.results.description import Description, Fact, line
from rocksteady.results.result import describes


@describes(Certificate)
def describe_certificate(certificate: Certificate) -> Description:
    """Return the claim, the verdict, and what is known beside it."""
    headline = f"{certificate.verdict}: {certificate.claim}"
    why = f"{headline}; {certificate.reason}" if certificate.reason else headline
    shown = [line(fact.label, fact.words) for fact in certificate.facts if fact.label]
    facts = [
        *shown[:4],
        line("holds for", f"{meaning(certificate.model)}; linear equations"),
        Fact("proved", certificate.proved, "proved"),
        Fact("verdict", certificate.verdict),
        Fact("claim", certificate.claim, "claim"),
        Fact("reason", certificate.reason, "reason" if certificate.reason else ""),
        Fact("bits", certificate.bits, "bits"),
        *certificate.facts,
        Fact("numbers", {name: list(texts) for name, texts in certificate.model.items()}),
    ]
    notes = [meaning(certificate.model)] if certificate.proved else []
    return Description(headline, facts, notes=notes, sentence=why[:1].upper() + why[1:])


@describes(ProvedRegion)
def describe_region(region: ProvedRegion) -> Description:
    """Return the shares of the area, and the ranges."""
    (low, high), (slow, fast) = region.amplitude, region.frequency_ratio
    ranges = f"A {low:.15g} to {high:.15g}, W {slow:.15g} to {fast:.15g}"
    what = f"order {region.order}, branch 1, restitution {region.restitution[0]}"
    headline = f"proved on {100.0 * region.decided:.2f} % of {ranges}: {what}"
    parts = [line(words, f"{100.0 * share:.2f} %") for words, share in region.shares.items()]
    count = sum(letter != SPLIT for letter in region.tree)
    return Description(
        headline,
        [
            Fact("decided", region.decided, "decided", f"{100.0 * region.decided:.2f} %"),
            Fact("shares", region.shares),
            *parts,
            Fact("boxes", count, "boxes", f"{count:,}"),
        ],
        sentence=headline[:1].upper() + headline[1:],
    )


@describes(CheckedCertificate)
def describe_checked(checked: CheckedCertificate) -> Description:
    """Return the verdict and the reason."""
    headline = (
        f"the certificate {'holds' if checked.holds else f'is {checked.verdict}'}: {checked.kind}"
    )
    if checked.verdict == SAMPLED:
        headline = f"sampled, and not refuted: {checked.kind}"
    further = "; ".join(filter(None, (checked.reason or checked.claim, checked.coverage)))
    sentence = f"{headline}; {further}" if further else headline
    facts = [
        Fact("holds", checked.holds, "holds"),
        Fact("kind", checked.kind, "kind"),
        Fact("verdict", checked.verdict, "verdict"),
        Fact("reason", checked.reason, "reason" if checked.reason else ""),
        Fact("claim", checked.claim, "claim" if checked.claim else ""),
        *([Fact("coverage", checked.coverage, "checked")] if checked.coverage else []),
    ]
    return Description(headline, facts, sentence=sentence[:1].upper() + sentence[1:])
