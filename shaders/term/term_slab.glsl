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
uniform vec3 boundsMin;   // nothing is seen outside
uniform vec3 boundsMax;

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

End endAt(vec3 place, vec3 perDepth, float depth, float partLength) {
    vec3 p = place + depth * perDepth;
    Sample s = termAt(p);
    bool inside = all(greaterThanEqual(p, boundsMin)) && all(lessThanEqual(p, boundsMax));
    float opacity = inside && s.opacity > 0.0 ? min(s.opacity, 0.9999) : 0.0;
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

vec4 termSlab(vec3 place, vec3 perDepth, mat3 jacobian, vec3 ray) {
    float partDepth = slabDepth / float(segments);
    float partLength = partDepth * length(ray);
    vec3 seen = vec3(0.0);
    float through = 1.0;
    End left;
    End last;
    for (int s = 0; s < segments; ++s) {
        Pile front = emptyPile();
        Pile back = emptyPile();
        End right;
        float depth = (float(s) - 0.5 * float(segments)) * partDepth;
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
                    back = over(piece(now, right, 1.0 / partDepth), back);
                    right = now;
                } else {
                    front = over(front, piece(left, now, 1.0 / partDepth));
                    left = now;
                }
                more = level < refinements && abs(left.alpha - right.alpha) > kContrast;
                depth = 0.5 * (left.depth + right.depth);
            }
            ++level;
        }
        Pile part = over(over(front, piece(left, right, 1.0 / partDepth)), back);
        float alpha = 1.0 - part.through;
#ifdef SHADED
        // Where there is a jump, the mean place could be a clear one.
        float where = level > 2 ? part.widestDepth : part.where / max(alpha, 1e-20);
        Sample lit = litTermAt(place + where * perDepth);
        vec2 light = reflected(lit.gradient * jacobian, ray);
        if (alpha > 0.0) part.seen = part.seen * light.x + alpha * light.y;
#endif
        seen += through * part.seen;
        through *= part.through;
    }
    return vec4(seen, 1.0 - through);
}
