"""A freeze of every answer: records of what the package prints, returns and writes.

Left out is what differs without a change of an answer: durations, versions, hashes of sources,
temporary folders and addresses; who computed a store (`source`, `rocksteady_version`, `case`);
scripts, styles and kernels inside the explorer's page, which is recorded by what it answers;
`doctor` and executors on a GPU or at an address; the order in which libraries list attributes.  Any
NaN equals any other.
"""
