#!/usr/bin/env bash
# OpenImageIO 2.4.7 (Debian 12): which commands see the second part of an OpenEXR picture, and which drop it in silence.
#
# Input: two valid OpenEXR pictures of two parts each, 4 x 4 pixels, made by oiiotool; their second parts differ.
# Guess: without -a every command of oiiotool works on the first part alone; a comparison that saw one of two parts fails.
# Seen: a plain copy, a change of data type and --ch keep both parts; --mulc keeps the first alone and says nothing.
#       idiff compares the first parts, says so on stdout, and passes with exit code 0; with -a it fails as it should.
# What follows: give -a to oiiotool and to idiff wherever a frame's viewports are parts of one file.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# The tools alone; their libraries come with libopenimageio-dev, which scripts/install-packages installs.
apt-get download -q openimageio-tools=2.4.7.1+dfsg-2 > /dev/null
dpkg -x ./openimageio-tools_*.deb .
tools=usr/bin

fill() { echo --create 4x4 3 "--fill:color=$1" 4x4; }
# shellcheck disable=SC2046
{
  $tools/oiiotool $(fill 0.5,0.5,0.5) $(fill 0.25,0.25,0.25) --siappend -o a.exr
  $tools/oiiotool $(fill 0.5,0.5,0.5) $(fill 0.75,0.25,0.25) --siappend -o b.exr
}

expect_parts() {
  local count=$1 file=$2
  shift 2
  local said
  said=$("$@" 2>&1)
  echo "$(basename "$1") ${*:2}: $count part(s); it said: \"$said\""
  if [[ $count == 2 ]]; then
    $tools/iinfo "$file" | grep -q "2 subimages"
  else
    ! $tools/iinfo "$file" | grep -q "subimages" && [[ -z $said ]]
  fi
}
expect_parts 2 copy.exr $tools/oiiotool a.exr -o copy.exr
expect_parts 2 half.exr $tools/oiiotool a.exr -d half -o half.exr
expect_parts 2 channels.exr $tools/oiiotool a.exr --ch R,G,B -o channels.exr
expect_parts 1 twice.exr $tools/oiiotool a.exr --mulc 2 -o twice.exr
expect_parts 2 all.exr $tools/oiiotool -a a.exr --mulc 2 -o all.exr

$tools/idiff a.exr b.exr
if $tools/idiff -a a.exr b.exr > /dev/null; then
  echo "idiff -a passes pictures that differ" >&2
  exit 1
fi
echo "idiff passed what idiff -a fails"
