"""Where each public name is defined."""

from .certify.proofs.certificate import Certificate as Certificate
from .certify.proofs.chaos import certify_chaos as certify_chaos
from .certify.proofs.fate import certify_edges as certify_edges
from .certify.proofs.fate import certify_fate as certify_fate
from .certify.proofs.files import CheckedCertificate as CheckedCertificate
from .certify.proofs.files import check_certificate as check_certificate
from .certify.proofs.orbit import certify_orbit as certify_orbit
from .certify.proofs.point import certify_point as certify_point
from .certify.proofs.region import ProvedRegion as ProvedRegion
from .certify.proofs.region import certify_region as certify_region

__all__: list[str]
