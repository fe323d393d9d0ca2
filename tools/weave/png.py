"""What a figure needs to know of PNG files."""

import struct

SIGNATURE = 8
CURVE = (b"gAMA", b"sRGB", b"iCCP", b"cHRM")


def strip_curve(path):
    """Takes away what the file says of its curve, so that a viewer takes its
    bytes for sRGB, whatever they are."""
    data = path.read_bytes()
    kept, at = data[:SIGNATURE], SIGNATURE
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        end = at + 12 + length
        if kind not in CURVE:
            kept += data[at:end]
        at = end
    path.write_bytes(kept)
