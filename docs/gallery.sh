#!/usr/bin/env bash
# Makes docs/gallery.md and its pictures from resources/scenes/gallery, with the release build:
#   docs/gallery.sh
set -euo pipefail
cd "$(dirname "$0")/.."
voledit=${VOLEDIT:-build/release/voledit}
mkdir -p docs/gallery

entry() {  # NAME TITLE TEXT
    local scene=resources/scenes/gallery/$1.voledit
    "$voledit" render "$scene" -o "docs/gallery/$1.png" --size 640x480
    printf '## %s\n\n![%s](gallery/%s.png)\n\n%s [`%s`](../%s)\n\n' "$2" "$2" "$1" "$3" "$1.voledit" "$scene" >>docs/gallery.md
}

cat >docs/gallery.md <<'TEXT'
# Gallery

The figures of the STF paper (Chen, Silver, Winter, Singh, Cornea 2003) that voledit covers, drawn by slices. Every scene is a file in
[`resources/scenes/gallery`](../resources/scenes/gallery): open it in the editor and drag its numbers. No volume is resampled in any of them.
`docs/gallery.sh` makes this page.

TEXT
entry fig1a "1a · A ball" "A translucent shell about a solid core: the union of two solids."
entry fig1b "1b · Split" "\`split\` moves the halves apart along x; between them the map is undefined, so nothing is there."
entry fig1c "1c · Squeeze" "\`squeeze\` narrows the ball about its waist."
entry fig1d "1d · Rotational sweep" "\`rotationalSweep\` turns the ball's section about an axis beside it, through 270°."
entry fig2a "2a · Swept, then split" "A list of two transfers: the sweep of 1d, then a split of what it made."
entry fig2b "2b · A composite squeezed" "One \`squeeze\` of the union of the ball and a cylinder with an amorphous layer: transfers apply to whole terms."
entry fig2c-top "2c · A cylinder with an amorphous layer" "The layer's opacity is a formula: noise that fades with the distance from the surface."
entry fig2c-bottom "2c · The composite" "The union of 1a and the cylinder, as 2b squeezes it."
entry fig3a "3a · A heart" "CT angiography, cut out of the chest by \`cap\` with an ellipsoid. Nothing is transferred yet."
entry fig3b "3b · Torn open" "\`open\` with profile 2: Ψ₁, the tear."
entry fig3c "3c · Four quarters" "\`dissect\` along two axes: Ψ₂ of the paper."
entry fig3d "3d · Inside out" "\`insideOut\` about an axis through a chamber: Ψ₃."
entry fig4 "4 · A chest opened" "\`open\`, hinged at the top: Ψ₄. [\`fig4-head.voledit\`](../resources/scenes/gallery/fig4-head.voledit) opens a head in the same way; its scan may not be shipped, so it is read from outside with \`--allow-outside\`."
entry fig7a "7a · A scan squeezed" "\`squeeze\` of a CT of the chest."
entry fig7b "7b · A scan twisted" "\`twist\` by 120° over its height."
entry fig8a "8a · Free form: bulge" "A Bézier lattice of 6 × 4 × 4 points over letters, which are signed distances from a font's outlines."
entry fig8b "8b · Free form: wave" "The letters raised and lowered along the line."
entry fig8c "8c · Free form: twist" "A lattice twisted about the line of text."
entry fig8d "8d · Free form: perspective" "A lattice that grows from one end to the other."
entry fig8e "8e · Free form: bend" "The text bent horizontally, by a lattice of degree 9 along it."

# Motion: a still of the parts moving apart, five frames of the walk side by side, and a still of the bones.
moment() {  # NAME SECONDS TITLE TEXT
    local scene=resources/scenes/gallery/$1.voledit
    "$voledit" render "$scene" -o "docs/gallery/$1.png" --time "$2" --size 640x480
    printf '## %s\n\n![%s](gallery/%s.png)\n\n%s [`%s`](../%s)\n\n' "$3" "$3" "$1" "$4" "$1.voledit" "$scene" >>docs/gallery.md
}
moment fig9 1.5 "9 · Regions moving apart" "An actor in \`disjoint\` mode: each limb of the skeleton keeps its rigid box, and keys on the joints carry them off. Nothing is copied: every piece is the one volume, looked up elsewhere."
if command -v montage >/dev/null; then
    frames=$(mktemp -d)
    for n in 0 6 12 18 24; do
        "$voledit" render resources/scenes/gallery/fig10.voledit -o "$frames/$(printf %02d $n).png" --time "$(awk "BEGIN { print $n / 24 }")" --size 270x480
    done
    montage "$frames"/*.png -tile 5x1 -geometry +1+0 -background '#0e0f13' docs/gallery/fig10.png
    rm -r "$frames"
else
    "$voledit" render resources/scenes/gallery/fig10.voledit -o docs/gallery/fig10.png --time 0.5 --size 640x480
    echo "docs/gallery/fig10.png is one frame only: ImageMagick's montage is not installed" >&2
fi
printf '## 10 · A walk\n\n![10 · A walk](gallery/fig10.png)\n\n%s [`fig10.voledit`](../resources/scenes/gallery/fig10.voledit)\n\n' "Five frames of motion capture on a still volume of a person: \`voledit rig\` laid the skeleton of 24 limbs into it, and the motion, of another skeleton, drives it by the joints' names. No volume is made for any frame." >>docs/gallery.md
moment anatomy 0.5 "Anatomy" "The same walk of a union: bones of solids within the translucent person. The actor moves the whole term. (So many solids under cells that overlap are left to rays.)"

# The README's strip of six.
if command -v montage >/dev/null; then
    (cd docs/gallery && montage fig1b.png fig2b.png fig3b.png fig4.png fig9.png anatomy.png -tile 3x2 -geometry 400x300+2+2 -background '#0e0f13' ../pictures/gallery.png)
else
    echo "docs/pictures/gallery.png is left as it was: ImageMagick's montage is not installed" >&2
fi
