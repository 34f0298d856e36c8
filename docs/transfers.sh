#!/usr/bin/env bash
# Makes docs/transfers.md again from resources/transfers, with the release build: docs/transfers.sh
set -euo pipefail
cd "$(dirname "$0")/.."
"${VOLEDIT:-build/release/voledit}" transfers --markdown >docs/transfers.md
