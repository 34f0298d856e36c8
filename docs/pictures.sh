#!/usr/bin/env bash
# Makes the pictures of the README again, from the release build: docs/pictures.sh
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build/pictures docs/pictures
build/release/voledit render resources/scenes/welcome.voledit -o docs/pictures/welcome.png --size 960x720
build/release/voledit render resources/scenes/light.voledit -o docs/pictures/light.png --size 960x720
build/release/voledit edit resources/scenes/welcome.voledit --headless --size 1280x800 --play docs/pictures.events
build/release/voledit edit resources/scenes/gallery/fig2b.voledit --headless --size 1280x800 --play docs/algebra.events
build/release/voledit edit resources/scenes/gallery/fig10.voledit --headless --size 1280x800 --play docs/actor.events
cp build/pictures/editor.png build/pictures/algebra.png build/pictures/actor.png docs/pictures/
