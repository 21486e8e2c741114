"""`rocksteady simulate --friction`: what slides is no rocking alone, whatever the motion."""

from tests.cli.program import rocksteady
from tests.every import every

BLOCK = "simulate --width-m 0.5 --height-m 2"
MOTIONS = [
    "--record example:near-fault",
    "--record example:near-fault --scale 0.1",  # never lifts
    "--pulse one-sine --accel-g 0.5 --freq-hz 1",
    "--accel-g 0.4 --freq-hz 1 --cycles 5",
    "--accel-g 0.1 --freq-hz 1 --cycles 5",
    "--start 0.6,0",
    "--record example:near-fault --one-sided",
]


@every("motion", MOTIONS)
def test_every_motion_of_a_block_with_a_size_has_a_need(motion: str) -> None:
    free = rocksteady(f"{BLOCK} {motion} --friction 3 --json")
    need = free.json["friction_needed"]
    assert 0.0 < need < 3.0
    assert free.json["friction"] == 3.0
    screen = rocksteady(f"{BLOCK} {motion} --friction 3").out
    assert "given 3" in screen
    assert "It slides" not in screen
    low = rocksteady(f"{BLOCK} {motion} --friction {0.9 * need}")
    assert low.out.startswith(f"It slides: it needs a friction of {need:.3g}, given ")
    assert "  without sliding  it " in low.out
    assert ": it slides" in low.out
    assert low.code == free.code
    assert len(low.out.splitlines()) <= 9
    plain = rocksteady(f"{BLOCK} {motion} --json").json
    same = rocksteady(f"{BLOCK} {motion} --friction {0.9 * need} --json").json
    assert same == {**plain, **{key: same[key] for key in same if "friction" in key}}
    assert "friction" not in plain


def test_just_enough_is_enough() -> None:
    """Of a push below uplift the need is the push itself."""
    ran = rocksteady(f"{BLOCK} --accel-g 0.2 --freq-hz 1 --cycles 2 --friction 0.2001")
    assert ran.out.startswith("It never lifts")
