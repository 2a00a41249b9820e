"""The i-PI protocol: models served to any driver (`python -m lanescape.ipi`, Client), and any client as a landscape (SocketLandscape)."""

from lanescape.ipi.client import Client
from lanescape.ipi.landscape import SocketLandscape

__all__ = ["Client", "SocketLandscape"]
