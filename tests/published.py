"""Numbers printed in the reference results that tests of two layers hold."""

TW1 = [
    # (amplitude, frequency ratio, restitution, order), phase, velocity, peak of branch 1
    ((2.0, 4.0, 0.8, 1), 2.8465425429, 0.1830972718, 0.1854991060),
    ((2.0, 6.0, 0.8, 3), 1.7852919857, 0.1073819482, 0.2888312915),
    ((3.0, 8.0, 0.95, 3), 2.8781538751, 0.1078741335, 0.1605680074),
    ((1.0, 2.0, 0.5, 1), 2.0129317200, 0.2756474666, 0.3407162565),
]
