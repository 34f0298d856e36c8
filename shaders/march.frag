#version 450 core
// march.frag: one fragment walks its whole view ray through one volume.
// The ray is cut at whole numbers of steps from where it enters the volume; some of them make a block. Blocks in which
// nothing can be seen are passed at a stride; of the others the scalar is taken at every step, is linear between, and each
// stretch between two steps takes optical depth and colour from the integrated table. Software renderers run every branch of
// a loop's body for all fragments of a group, so what is dear stands after a loop that goes on until all of the group need
// it or are through.
//   variants  STEPS=n      values taken for a block: as many steps, one less at its first
//             SHADED       Blinn-Phong by the gradient, where a stretch is seen
//             SURROUNDINGS with shadows and occlusion
//             REAL_VOXELS  the volume holds floats, which may be NaN: nothing is seen there
//             BAKED        the volume lies under a map, known at the nodes of a grid (core/eval/baked_map.h)
//   places    index coordinates of the volume; BAKED: coordinates of that grid
//   out       color        premultiplied by alpha, as composited
#include "common/volume.glsl"
#include "common/lighting.glsl"
#include "common/surroundings.glsl"
#include "common/cut_normal.glsl"
#include "common/volume_cut.glsl"
#include "march/table.glsl"
#include "march/ray.glsl"

layout(location = 0) out vec4 color;

uniform float least;  // what is let through of the light behind, below which a ray ends

// The steps of one block. Its beginning is the end of the one before.
struct Block {
    Line line;
    float at[STEPS + 1];  // on the line
    int bin[STEPS + 1];   // -1: there is no value
};

// Takes the values of the block at u. False only if nothing is seen in it.
// first  the steps that its first value, after the one at its beginning, is away from there: 1, or 0 where that is not
//        known, as the block does not follow another one; it is a step shorter then
bool sampleBlock(Ray ray, float u, float first, inout Block block) {
    vec2 within = nextLine(ray, u, block.line);
    block.bin[0] = first > 0.0 ? block.bin[STEPS] : -1;
    block.at[0] = within.x;
    int low = block.bin[0] < 0 ? 1 << 20 : block.bin[0];
    int high = block.bin[0];
    for (int s = 1; s <= STEPS; ++s) {
        block.at[s] = clamp(blockBegin(u) + first + float(s - 1), within.x, within.y);
        float raw = rawAt(indexOn(block.line, block.at[s]));
        int bin = binOf(raw);
        low = min(low, bin);
        high = max(high, bin);
#ifdef REAL_VOXELS
        if (!isNumber(raw)) bin = -1;
#endif
        block.bin[s] = bin;
    }
    return within.x < within.y && mayAbsorb(low, high);
}

// Share of a stretch at which its light comes from in the mean: nearer to the end that absorbs more, and to the front.
float meanPlace(vec2 extinction, float depth) {
    float both = extinction.x + extinction.y;
    float middle = both > 0.0 ? (extinction.x + 2.0 * extinction.y) / (3.0 * both) : 0.5;
    return middle * (1.0 - min(depth / 6.0, 0.5));
}

// What lies between two steps of a block.
struct Stretch {
    int from, to;  // bins
    float begin, end;
};

#ifdef SHADED
int absorbingStretches(Block block) {
    int absorbing = 0;
    for (int s = 0; s < STEPS; ++s) {
        int low = min(block.bin[s], block.bin[s + 1]);
        int high = max(block.bin[s], block.bin[s + 1]);
        if (low >= 0 && block.at[s] < block.at[s + 1] && mayAbsorb(low, high)) absorbing |= 1 << s;
    }
    return absorbing;
}

// Takes the first one from those that absorb.
Stretch nextStretch(Block block, inout int absorbing) {
    Stretch stretch = Stretch(0, 0, 0.0, 0.0);
    for (int s = STEPS - 1; s >= 0; --s) {
        bool absorbs = (absorbing & (1 << s)) != 0;
        stretch.from = absorbs ? block.bin[s] : stretch.from;
        stretch.to = absorbs ? block.bin[s + 1] : stretch.to;
        stretch.begin = absorbs ? block.at[s] : stretch.begin;
        stretch.end = absorbs ? block.at[s + 1] : stretch.end;
    }
    absorbing &= absorbing - 1;
    return stretch;
}
#endif

// Composites a stretch of the block that begins at a u under what is seen already.
void composite(Ray ray, Block block, float begin, Stretch stretch, inout vec3 seen, inout float through) {
    vec2 ends;
    vec4 what = between(max(stretch.from, 0), max(stretch.to, 0), ends);
    float depth = what.a * (stretch.end - stretch.begin) * ray.unit;
#ifdef REAL_VOXELS
    if (min(stretch.from, stretch.to) < 0) depth = 0.0;
#endif
    float weight = through * (1.0 - exp(-depth));
#ifdef SHADED
    float place = mix(stretch.begin, stretch.end, meanPlace(ends, depth));
    vec3 index = indexOn(block.line, place);
    mat3 jacobian = indexJacobian(ray, begin - blockBegin(begin) + place);
    vec3 gradient = withCut(cutBy(enteredBefore(index, jacobian, ray.direction), ray.direction), rawDifferencesAt(index) * jacobian);
    vec2 share = lightShareAt(ray.depth + (begin - blockBegin(begin) + place) * ray.depthPerStep, ray.direction);
    vec2 light = reflected(gradient, ray.direction, share);
    what.rgb = what.rgb * light.x + light.y;
#endif
    if (depth > 0.0) {
        seen += weight * what.rgb;
        through -= weight;
    }
}

void main() {
    Ray ray = viewRay(gl_FragCoord.xy);
    vec3 seen = vec3(0.0);
    float through = 1.0;
    float u = ray.first;
    float begin = 0.0;     // of the block
    bool follows = false;  // the block before was looked at, too
    Block block;
    block.bin[STEPS] = -1;
    block.line = noLine();
    while (true) {
        bool any = false;
        while (u < ray.last) {
            float to = stride(ray, u);
            follows = follows && to == u;
            u = to;
            if (u >= ray.last) break;
            begin = u;
#ifdef BAKED
            any = sampleBlock(ray, u, 1.0, block) && follows;
            u += float(STEPS);
#else
            float first = follows ? 1.0 : 0.0;
            any = sampleBlock(ray, u, first, block);
            u += float(STEPS - 1) + first;
#endif
            follows = true;
            if (any) break;
        }
        if (!any) break;
#ifdef SHADED
        // Stretches that absorb, as bits: the gradient is taken of no others.
        int absorbing = absorbingStretches(block);
        while (absorbing != 0) {
            composite(ray, block, begin, nextStretch(block, absorbing), seen, through);
            if (through <= least) break;
        }
#else
        for (int s = 0; s < STEPS; ++s) {
            Stretch stretch = Stretch(block.bin[s], block.bin[s + 1], block.at[s], block.at[s + 1]);
            composite(ray, block, begin, stretch, seen, through);
        }
#endif
        if (through <= least) break;
    }
    if (through == 1.0) discard;
    color = vec4(seen, 1.0 - through);
}
