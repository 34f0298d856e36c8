// term/term_slab.glsl: colour and opacity of a slab of any term.
// The term is sampled at the ends of `segments` equal parts of the slab. Where two ends of a part differ in how opaque
// they make it, the part is halved, and then again the half that differs more: a jump is found by bisection, each side
// getting its length, and what is smooth is halved once or twice. Pieces are composited front to back; each part is lit by
// the gradient at the mean place of what is seen of it. One loop evaluates the term, so that compilers inline it once.
// Needs the generated functions, common/lighting.glsl.

uniform float slabDepth;        // extent of a slab along the view axis, world units
uniform float opacityDistance;  // world units
uniform int segments;
uniform int refinements;  // halvings of a part at most
uniform vec3 boundsMin;   // of places; nothing is seen outside
uniform vec3 boundsMax;
uniform float rounding;  // how far outside a place may come out by single precision

const float kContrast = 0.015;  // difference of two ends' alphas from which on a part is halved

// The term at a depth from the slice.
struct End {
    float depth;
    float thickness;  // optical thickness of one part if all of it were like here
    float alpha;      // the part's then
    vec3 color;
};

// Pieces composited so far.
struct Pile {
    vec3 seen;
    float through;
    float where;   // sum of depth by what is seen
    float widest;  // the largest share of a piece, and its depth
    float widestDepth;
};

Pile emptyPile() {
    return Pile(vec3(0.0), 1.0, 0.0, 0.0, 0.0);
}

bool withinBounds(vec3 p) {
    return all(greaterThanEqual(p, boundsMin - rounding)) && all(lessThanEqual(p, boundsMax + rounding));
}

#ifdef SHADED
#include "term/cut.glsl"
#endif

// The part of the ray, by depth from the slice, that its slab stands for: half a slab on either side, but where cells end
// exactly up to there, as the neighbouring slice draws nothing. Bricks reach half a slab beyond the bounds.
vec2 slabExtent(vec3 place, vec3 perDepth) {
    vec2 middle = vec2(-0.5, 0.5) * slabDepth;
#ifdef MAPPED
    vec3 safe = mix(perDepth, vec3(1e-20), lessThan(abs(perDepth), vec3(1e-20)));
    vec3 toMin = (boundsMin - place) / safe;
    vec3 toMax = (boundsMax - place) / safe;
    vec3 enter = min(toMin, toMax);
    vec3 leave = max(toMin, toMax);
    float first = min(max(max(enter.x, enter.y), enter.z), 0.0);
    float last = max(min(min(leave.x, leave.y), leave.z), 0.0);
    middle = vec2(first > -slabDepth ? first : middle.x, last < slabDepth ? last : middle.y);
#endif
    return middle;
}

End endAt(vec3 place, vec3 perDepth, float depth, float partLength) {
    vec3 p = place + depth * perDepth;
    Sample s = termAt(p);
    float opacity = withinBounds(p) && s.opacity > 0.0 ? min(s.opacity, 0.9999) : 0.0;
    float thickness = -log(1.0 - opacity) * partLength / opacityDistance;
    return End(depth, thickness, 1.0 - exp(-thickness), opacity > 0.0 ? s.color : vec3(0.0));
}

// Share of a piece's length at which its light comes from in the mean.
float meanPlace(float thickness) {
    return thickness < 0.05 ? 0.5 - thickness / 12.0 : 1.0 / thickness - exp(-thickness) / (1.0 - exp(-thickness));
}

// What lies between two ends, behind or in front of the pile.
Pile piece(End a, End b, float perPart) {
    float thickness = 0.5 * (a.thickness + b.thickness) * (b.depth - a.depth) * perPart;
    float share = 1.0 - exp(-thickness);
    float both = a.thickness + b.thickness;
    vec3 color = both > 0.0 ? (a.thickness * a.color + b.thickness * b.color) / both : vec3(0.0);
    float depth = mix(a.depth, b.depth, meanPlace(thickness));
    return Pile(share * color, 1.0 - share, share * depth, share, depth);
}

Pile over(Pile front, Pile back) {
    float widest = front.through * back.widest;
    bool behind = widest > front.widest;
    return Pile(front.seen + front.through * back.seen, front.through * back.through,
                front.where + front.through * back.where, behind ? widest : front.widest,
                behind ? back.widestDepth : front.widestDepth);
}

#ifdef SHADED
// What is seen of a part, lit at one place.
vec3 lit(Pile part, bool jumps, vec3 place, vec3 perDepth, mat3 jacobian, vec3 ray) {
    float alpha = 1.0 - part.through;
    float where = jumps ? part.widestDepth : part.where / max(alpha, 1e-20);
    vec3 at = place + where * perDepth;
    vec3 gradient = litTermAt(at).gradient * jacobian;
    if (cutThickness > 0.0)
        gradient = withCut(cutBefore(at, perDepth / length(ray), normalize(ray), jacobian), gradient);
    vec2 light = reflected(gradient, ray, lightShare(where, alpha, ray));
    return part.seen * light.x + alpha * light.y;
}
#endif

vec4 termSlab(vec3 place, vec3 perDepth, mat3 jacobian, vec3 ray) {
    vec2 extent = slabExtent(place, perDepth);
    float partDepth = (extent.y - extent.x) / float(segments);
    float partLength = partDepth * length(ray);
    float perPart = 1.0 / max(partDepth, 1e-30);
    Pile slab = emptyPile();
    End left;
    End last;
    for (int s = 0; s < segments; ++s) {
        Pile front = emptyPile();
        Pile back = emptyPile();
        End right;
        float depth = extent.x + float(s) * partDepth;
        int level = s == 0 ? -1 : 0;
        if (s > 0) {
            left = last;
            depth += partDepth;
        }
        bool more = true;
        while (more) {
            End now = endAt(place, perDepth, depth, partLength);
            if (level < 0) {
                left = now;
                depth += partDepth;
            } else {
                if (level == 0) {
                    right = now;
                    last = now;
                } else if (abs(left.alpha - now.alpha) >= abs(now.alpha - right.alpha)) {
                    back = over(piece(now, right, perPart), back);
                    right = now;
                } else {
                    front = over(front, piece(left, now, perPart));
                    left = now;
                }
                more = level < refinements && abs(left.alpha - right.alpha) > kContrast;
                depth = 0.5 * (left.depth + right.depth);
            }
            ++level;
        }
        Pile part = over(over(front, piece(left, right, perPart)), back);
#ifdef SHADED
        // Where there is a jump, the mean place could be a clear one.
        if (part.through < 1.0) part.seen = lit(part, level > 2, place, perDepth, jacobian, ray);
#endif
        slab = over(slab, part);
    }
    return vec4(slab.seen, 1.0 - slab.through);
}
