"""Addresses of dask schedulers, as far as they can be judged without a try."""

from contextlib import suppress
from importlib.util import find_spec
from ipaddress import ip_address

from rocksteady.errors import InputError

MOST_PORTS = 65535


def validated_address(address: str) -> str:
    """Return an address that a scheduler may have.

    Raises
    ------
    InputError
        If dask knows no such kind of address, or it has no host or no port.
    """
    if find_spec("distributed") is None:
        return address  # whoever connects says so
    from distributed.comm.registry import backends, get_backend

    kind, _, place = address.rpartition("://")  # as dask does
    try:
        backend = get_backend(kind)
    except (ValueError, ImportError) as error:
        known = ", ".join(sorted(backends))
        raise _refused(address, f"dask knows addresses of the kinds {known}") from error
    with suppress(NotImplementedError):  # of kinds without hosts and ports
        try:
            host, port = backend.get_address_host_port(place)
        except ValueError:
            host, port = "", 0
        if not host or not 0 < port <= MOST_PORTS:
            raise _refused(
                address, f"it must have a host and a port, a number from 1 to {MOST_PORTS}"
            )
    return address


def open_to_others(address: str) -> bool:
    """Return whether a scheduler's address is on a network, and its connections have no TLS.

    Who reaches such a scheduler, or its workers, can have them run any program.
    """
    kind, _, place = address.rpartition("://")
    if kind not in {"", "tcp", "ws", "ucx"}:  # tls and wss; inproc never leaves its process
        return False
    host = place.rpartition(":")[0].strip("[]")
    try:
        return not ip_address(host.partition("%")[0]).is_loopback
    except ValueError:
        return host != "localhost" and not host.endswith(".localhost")


def _refused(address: str, valid: str) -> InputError:
    return InputError(
        name="executor", value=address, valid=valid, hint="give it as tcp://127.0.0.1:8786"
    )
