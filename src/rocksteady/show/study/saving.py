"""Computed studies as folders of files."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import ClassVar

from rocksteady.show.export.folders import check_folder, fill_folder
from rocksteady.show.study.environment import Done, nothing
from rocksteady.show.study.parts import Parts


def fill_study(
    folder: Path | str,
    write: Callable[[Path], None],
    check: Callable[[], None],
    parts: Parts | None,
) -> list[Path]:
    """Fill the folder of a study, which may hold its finished parts.

    Parameters
    ----------
    folder, write, check
        As for `fill_folder`.
    parts
        Where what is finished is kept: nothing half written is left elsewhere.

    Returns
    -------
    list of Path
        The written files.

    Raises
    ------
    OutputError
        As for `fill_folder`.
    """
    if parts is not None:
        check()
        parts.begin()
    return fill_folder(folder, write, check, within=None if parts is None else parts.folder)


class Saved(ABC):
    """A computed study whose pictures, tables, numbers and page are written at once."""

    ours: ClassVar[str]
    """Names of the files, as a regular expression."""

    def save(
        self,
        folder: Path | str,
        *,
        force: bool = False,
        parts: Parts | None = None,
        done: Done = nothing,
    ) -> list[Path]:
        """Write pictures, tables, the numbers as JSON and the page.

        Parameters
        ----------
        folder
            Made if it does not exist, in an existing folder.
        force
            Whether files of these names in it are replaced; others stay.
        parts
            Where what is finished is kept: nothing half written is left elsewhere.
        done
            Called with the name of each picture, and of the page, when it has been written.

        Returns
        -------
        list of Path
            The written files.

        Raises
        ------
        OutputError
            If the folder cannot be made or written, or a file exists and `force` is off.
        """
        check = partial(check_folder, folder, self.ours, force=force)
        return fill_study(folder, lambda stage: self.write(stage, done), check, parts)

    @abstractmethod
    def write(self, stage: Path, done: Done) -> None:
        """Write every file into a hidden folder."""
