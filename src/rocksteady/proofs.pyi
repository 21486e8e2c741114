"""Where each public name is defined."""

from .certify.certificate import Certificate as Certificate
from .certify.chaos import certify_chaos as certify_chaos
from .certify.fate import certify_edges as certify_edges
from .certify.fate import certify_fate as certify_fate
from .certify.files import CheckedCertificate as CheckedCertificate
from .certify.files import check_certificate as check_certificate
from .certify.orbit import certify_orbit as certify_orbit
from .certify.point import certify_point as certify_point
from .certify.region import ProvedRegion as ProvedRegion
from .certify.region import certify_region as certify_region

__all__: list[str]
