#!/usr/bin/env bash
# pfstools 2.2.0 (Debian 12) tints greys when it copies a Radiance picture, and encodes narrow ones unreadably.
#
# Input: valid Radiance pictures of grey pixels, mantissas 128 and exponent 129 (1.0), 8 and 7 columns wide, copied
#        by pfsinrgbe | pfsoutrgbe.
# Guess: the copy holds the same mantissas, or pixels that decode to the same values; scanlines of fewer than 8
#        columns are written flat, since the format has run lengths from 8 columns on only.
# Seen: 127, 128, 127: grey has become 0.8 % green (frames are kept as XYZ in between, and mantissas are cut off, not
#       rounded); the 7 columns are run-length coded all the same, and a reader that holds to the format takes the
#       mark (2, 2, 0, 7) for a pixel.
# What follows: do not pass environments through it before a comparison; keep environment pictures at 8 columns or more.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -q pfstools=2.2.0-5+b1 libpfs2=2.2.0-5+b1 > /dev/null
for package in ./*.deb; do dpkg -x "$package" .; done
export LD_LIBRARY_PATH="$folder/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)"

python3 - <<'WRITE'
for width in (7, 8):
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X %d\n" % width
    open("in%d.hdr" % width, "wb").write(head + bytes([128, 128, 128, 129]) * width)
WRITE
for width in 7 8; do usr/bin/pfsinrgbe in$width.hdr | usr/bin/pfsoutrgbe out$width.hdr; done

python3 - <<'CHECK'
for width in (7, 8):
    data = open("out%d.hdr" % width, "rb").read()
    pixels = data[data.index(b"\n-Y 1") :].split(b"\n", 2)[2]
    print("%d columns: %s" % (width, pixels.hex(" ")))
    # The mark of run lengths, then one run for each of red, green, blue and exponent.
    run = 128 + width
    wanted = bytes([2, 2, 0, width, run, 127, run, 128, run, 127, run, 129])
    assert pixels == wanted, "pfstools behaves otherwise now"
CHECK
