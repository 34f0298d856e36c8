#version 450 core
// overlay.frag: a line with round ends, or a disc, each with a ring; edges are smoothed over one pixel.
//   out   color   straight alpha

flat in vec4 lineEnds;
flat in vec2 lineRadii;
flat in vec4 lineFill;
flat in vec4 lineRing;
layout(location = 0) out vec4 color;

float distanceToLine(vec2 p) {
    vec2 along = lineEnds.zw - lineEnds.xy;
    float t = dot(p - lineEnds.xy, along) / max(dot(along, along), 1e-6);
    return length(p - lineEnds.xy - clamp(t, 0.0, 1.0) * along);
}

// Covered part of a pixel whose centre is `d` from the middle of something `radius` wide; thinner than a pixel it
// becomes fainter instead.
float coverage(float d, float radius) {
    return clamp(radius + 0.5 - d, 0.0, 1.0) * min(2.0 * radius, 1.0);
}

void main() {
    float d = distanceToLine(gl_FragCoord.xy);
    float fill = coverage(d, lineRadii.x);
    float all = lineRadii.y > lineRadii.x ? coverage(d, lineRadii.y) : fill;
    if (all <= 0.0) discard;
    float fillAlpha = lineFill.a * fill;
    float ringAlpha = lineRing.a * (all - fill);
    float alpha = fillAlpha + ringAlpha;
    if (alpha <= 0.0) discard;
    color = vec4((lineFill.rgb * fillAlpha + lineRing.rgb * ringAlpha) / alpha, alpha);
}
