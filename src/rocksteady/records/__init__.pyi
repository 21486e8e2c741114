"""Where each public name is defined."""

from .core.recording import Recording as Recording
from .pairing import RecordSet as RecordSet
from .pairing import pair_records as pair_records
from .processing import Cleaning as Cleaning
from .processing import resample as resample
from .read import read_recordings as read_recordings
from .suite import RecordSuite as RecordSuite

__all__: list[str]
