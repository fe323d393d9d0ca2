#!/bin/sh
# Writes the lock files for PyPI and npm, with versions and hashes of all packages:
# run it after a change in tools/setup/*.in or tools/package.json. UPGRADE=1 takes
# newer versions if these files allow it.
set -eu
cd "$(dirname "$0")"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet uv
for list in *.in; do
  "$folder/venv/bin/uv" pip compile --quiet --universal --python-version 3.11 \
    --generate-hashes --no-emit-index-url --no-header --no-annotate \
    ${UPGRADE:+--upgrade} "$list" -o "${list%.in}.txt"
done
cp ../package*.json "$folder"
cd "$folder"
[ -z "${UPGRADE:-}" ] || rm -f package-lock.json
npm install --silent --package-lock-only --ignore-scripts --no-audit --no-fund \
  --omit-lockfile-registry-resolved
cp package-lock.json "$OLDPWD/.."
