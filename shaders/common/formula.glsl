// common/formula.glsl: what functions made from formulas (core/expression) call, as core/expression/scalar_ops.h and
// noise.cpp define it. Own series rather than the built-in functions: those may err by 4000 roundings (asin, atan) and
// differ from driver to driver, while CPU and GPU are to agree to 1e-5. NaN is told by its bits and everything is
// `precise`, as compilers may take it for granted that nothing is NaN.
// The program defines, before its formulas: float formulaUniform(int k), the k-th uniform number.

float formulaNaN() { return uintBitsToFloat(0x7fc00000u); }
float formulaInfinity() { return uintBitsToFloat(0x7f800000u); }
bool formulaIsNaN(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool formulaIsInfinite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) == 0x7f800000u; }

// x times a zero: NaN for NaN and infinity, else a zero of the product's sign.
float formulaTimesZero(float x, float zero) {
    uint bits = floatBitsToUint(x);
    if ((bits & 0x7f800000u) == 0x7f800000u) return formulaNaN();
    return uintBitsToFloat((bits ^ floatBitsToUint(zero)) & 0x80000000u);
}

float formulaSign(float x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }
float formulaMin(float a, float b) { return formulaIsNaN(b) ? b : b < a ? b : a; }
float formulaMax(float a, float b) { return formulaIsNaN(b) ? b : a < b ? b : a; }
float formulaSqrt(float x) { return x < 0.0 ? formulaNaN() : sqrt(x); }

float formulaFract(float x) {
    precise float result = x - floor(x);
    return result;
}

float formulaMod(float x, float y) {
    precise float result = x - y * floor(x / y);
    return result;
}

float formulaHermite(float t) {
    precise float result = t * t * (3.0 - 2.0 * t);
    return result;
}

// 2 to the power of a whole number; in two factors, as one alone ends at 2^127.
float formulaScaled(float x, float exponent) {
    float e = clamp(exponent, -252.0, 254.0);
    float first = floor(0.5 * e);
    float a = uintBitsToFloat(uint(int(first) + 127) << 23), b = uintBitsToFloat(uint(int(e - first) + 127) << 23);
    precise float result = x * a * b;
    return result;
}

// e^r for |r| ≤ ln(2)/2.
float formulaExpNear0(float r) {
    precise float result =
        1.0 + (r + r * r * (0.5 + r * (0.166665763 + r * (0.0416665561 + r * (0.00836319476 + r * 0.00139262038)))));
    return result;
}

float formulaExp(float x) {
    if (x > 88.8) return formulaInfinity();
    if (x < -104.0) return 0.0;
    precise float k = floor(x * 1.44269504 + 0.5);
    precise float r = (x - k * 0.693359375) + k * 0.0002121944417;
    return formulaScaled(formulaExpNear0(r), k);
}

float formulaExp2(float x) {
    if (x > 128.5) return formulaInfinity();
    if (x < -150.0) return 0.0;
    precise float k = floor(x + 0.5);
    precise float r = (x - k) * 0.693147181;
    return formulaScaled(formulaExpNear0(r), k);
}

// x = 2^k · m with m in [√½, √2): (k, ln m), for positive finite x.
vec2 formulaLogParts(float x) {
    float small = x < 1.17549435e-38 ? 24.0 : 0.0;
    uint bits = floatBitsToUint(small > 0.0 ? x * 16777216.0 : x);
    int k = int(bits >> 23) - 127;
    float m = uintBitsToFloat((bits & 0x007fffffu) | 0x3f800000u);
    if (m > 1.41421356) {
        m *= 0.5;
        k += 1;
    }
    precise float s = (m - 1.0) / (m + 1.0);
    precise float z = s * s;
    precise float result = 2.0 * s + s * z * (0.666666865 + z * (0.399887323 + z * 0.295821577));
    return vec2(float(k) - small, result);
}

bool formulaLogIsSpecial(float x, out float result) {
    result = x;
    if (x == 0.0) result = -formulaInfinity();
    if (x < 0.0) result = formulaNaN();
    return !(x > 0.0) || formulaIsInfinite(x) || formulaIsNaN(x);
}

float formulaLog(float x) {
    float special;
    if (formulaLogIsSpecial(x, special)) return special;
    vec2 parts = formulaLogParts(x);
    precise float result = parts.x * 0.693359375 + (parts.y - parts.x * 0.0002121944417);
    return result;
}

float formulaLog2(float x) {
    float special;
    if (formulaLogIsSpecial(x, special)) return special;
    vec2 parts = formulaLogParts(x);
    precise float result = parts.x + parts.y * 1.44269504;
    return result;
}

// n ≥ 1: squares, the exponent's bits from the highest down.
float formulaIntegerPower(float x, int n) {
    precise float result = x;
    for (int bit = findMSB(n) - 1; bit >= 0; --bit) {
        result = result * result;
        if ((n >> bit & 1) != 0) result = result * x;
    }
    return result;
}

float formulaPow(float x, float y) {
    if (y == 0.0) return 1.0;
    if (abs(y) <= 16.0 && y == floor(y)) {
        precise float power = formulaIntegerPower(x, int(abs(y)));
        precise float inverse = 1.0 / power;
        return y > 0.0 ? power : inverse;
    }
    if (formulaIsNaN(x) || formulaIsNaN(y)) return formulaNaN();
    float size = abs(x);
    float result;
    if (size == 1.0) {
        result = 1.0;
    } else if (size == 0.0) {
        result = y > 0.0 ? 0.0 : formulaInfinity();
    } else {
        precise float exponent = y * formulaLog2(size);
        result = formulaExp2(exponent);
    }
    if (x < 0.0) {
        if (y != floor(y)) return formulaIsInfinite(x) ? result : formulaNaN();
        if (!formulaIsInfinite(y) && y != 2.0 * floor(0.5 * y)) result = -result;
    }
    return result;
}

// (sin x, cos x), reduced to |r| ≤ π/4 by three parts of π/2.
vec2 formulaSinCos(float x) {
    precise float k = floor(x * 0.636619772 + 0.5);
    precise float r = ((x - k * 1.5703125) - k * 0.0004837512969970703125) - k * 7.549790126e-08;
    precise float z = r * r;
    precise float s = r + r * z * (-0.166666672 + z * (0.00833333191 + z * (-0.000198400638 + z * 2.72468696e-06)));
    precise float c = 1.0 - 0.5 * z +
                      z * z * (0.0416666679 + z * (-0.00138888881 + z * (2.48005799e-05 - z * 2.72984067e-07)));
    float quadrant = k - 4.0 * floor(0.25 * k);
    if (quadrant == 1.0 || quadrant == 3.0) {
        float swapped = s;
        s = c;
        c = -swapped;
    }
    return quadrant >= 2.0 ? vec2(-s, -c) : vec2(s, c);
}

float formulaSin(float x) { return formulaSinCos(x).x; }
float formulaCos(float x) { return formulaSinCos(x).y; }

float formulaTan(float x) {
    vec2 sc = formulaSinCos(x);
    precise float result = sc.x / sc.y;
    return result;
}

// For |x| ≤ ½.
float formulaAsinNear0(float x) {
    precise float z = x * x;
    precise float result = x + x * z * (0.166666657 + z * (0.0750009418 + z * (0.0445994027 +
                           z * (0.0311006624 + z * (0.0171492379 + z * 0.0336908475)))));
    return result;
}

float formulaAcos(float x) {
    if (abs(x) > 1.0 || formulaIsNaN(x)) return formulaNaN();
    precise float near = 2.0 * formulaAsinNear0(sqrt(0.5 * (1.0 - abs(x))));
    precise float middle = 1.57079633 - formulaAsinNear0(x);
    precise float far = 3.14159265 - near;
    return x > 0.5 ? near : x < -0.5 ? far : middle;
}

float formulaAsin(float x) {
    if (abs(x) > 1.0 || formulaIsNaN(x)) return formulaNaN();
    if (abs(x) <= 0.5) return formulaAsinNear0(x);
    precise float result = 1.57079633 - 2.0 * formulaAsinNear0(sqrt(0.5 * (1.0 - abs(x))));
    return x < 0.0 ? -result : result;
}

// Zeros of either sign count as +0.
float formulaAtan2(float y, float x) {
    if (formulaIsNaN(x) || formulaIsNaN(y)) return formulaNaN();
    float most = max(abs(x), abs(y)), least = min(abs(x), abs(y));
    if (most == 0.0) return 0.0;
    precise float ratio = least / most;
    if (least == most) ratio = 1.0;
    precise float z = ratio * ratio;
    precise float angle =
        ratio + ratio * z * (-0.333333313 + z * (0.199997395 + z * (-0.142785683 + z * (0.110337645 +
        z * (-0.0865688026 + z * (0.0625016913 + z * (-0.0358715393 + z * (0.0135077713 - z * 0.00238699722))))))));
    if (abs(y) > abs(x)) angle = 1.57079633 - angle;
    if (x < 0.0) angle = 3.14159265 - angle;
    return y < 0.0 ? -angle : angle;
}

float formulaAtan(float x) { return formulaAtan2(x, 1.0); }

float formulaSinh(float x) {
    if (abs(x) < 1.0) {
        precise float z = x * x;
        precise float series = x + x * z * (0.166666667 + z * (8.33333333e-3 + z * (1.98412698e-4 + z * 2.75573192e-6)));
        return series;
    }
    // e^x ends before sinh does: the half is taken between two square roots of it.
    precise float root = formulaExp(0.5 * abs(x));
    precise float result = 0.5 * root * root - 0.5 / root / root;
    return x < 0.0 ? -result : result;
}

float formulaCosh(float x) {
    precise float root = formulaExp(0.5 * abs(x));
    precise float result = 0.5 * root * root + 0.5 / root / root;
    return result;
}

float formulaTanh(float x) {
    if (abs(x) < 0.625) {
        precise float z = x * x;
        precise float series = x + x * z * (-0.333333343 + z * (0.133332998 + z * (-0.0539584607 +
                               z * (0.0217625033 + z * (-0.00832318701 + z * 0.00226950157)))));
        return series;
    }
    precise float result = 1.0 - 2.0 / (formulaExp(2.0 * abs(x)) + 1.0);
    return x < 0.0 ? -result : result;
}

uint formulaHash(uvec3 p) {
    uint h = p.x * 0x8da6b343u ^ p.y * 0xd8163841u ^ p.z * 0xcb1ab31fu;
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}

vec3 formulaGradient(uint h) {
    uint g = h & 15u;
    float first = (g & 1u) != 0u ? -1.0 : 1.0, second = (g & 2u) != 0u ? -1.0 : 1.0;
    if (g < 4u) return vec3(first, second, 0.0);
    if (g < 8u) return vec3(first, 0.0, second);
    if (g < 12u) return vec3(0.0, first, second);
    return (g & 2u) != 0u ? vec3(0.0, -1.0, first) : vec3(first, 1.0, 0.0);
}

// 6t⁵ − 15t⁴ + 10t³, differentiated `order` times.
float formulaFade(float t, int order) {
    precise float u = 1.0 - t;
    precise float result = 0.0;
    if (order == 0) result = t * t * t * (1.0 + u * (3.0 + u * 6.0));
    if (order == 1) result = 30.0 * t * t * u * u;
    if (order == 2) result = 60.0 * t * u * (u - t);
    if (order == 3) result = 60.0 - 360.0 * t * u;
    if (order == 4) result = t * 720.0 - 360.0;
    if (order == 5) result = 720.0;
    return result;
}

// Weights of a cell's two ends, differentiated `order` times; zeros for order −1.
vec2 formulaWeights(float t, int order) {
    if (order < 0) return vec2(0.0);
    float upper = formulaFade(t, order);
    return vec2(order == 0 ? 1.0 - upper : -upper, upper);
}

uint formulaLatticeIndex(float x) { return abs(x) < 2147483648.0 ? uint(int(x)) : 0u; }

// Gradient noise, differentiated order.x times by x, order.y times by y, order.z times by z.
float formulaNoise(vec3 point, ivec3 order) {
    precise vec3 base = floor(point);
    precise vec3 offset = point - base;
    uvec3 cell = uvec3(formulaLatticeIndex(base.x), formulaLatticeIndex(base.y), formulaLatticeIndex(base.z));
    vec2 wx = formulaWeights(offset.x, order.x), wy = formulaWeights(offset.y, order.y), wz = formulaWeights(offset.z, order.z);
    vec2 lx = float(order.x) * formulaWeights(offset.x, order.x - 1), ly = float(order.y) * formulaWeights(offset.y, order.y - 1),
         lz = float(order.z) * formulaWeights(offset.z, order.z - 1);
    precise float sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 end = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        vec3 g = formulaGradient(formulaHash(cell + uvec3(end)));
        precise vec3 from = offset - vec3(end);
        precise float along = g.x * from.x + g.y * from.y + g.z * from.z;
        float x = wx[end.x], y = wy[end.y], z = wz[end.z];
        sum += x * y * z * along;
        if (order.x > 0) sum += lx[end.x] * y * z * g.x;
        if (order.y > 0) sum += ly[end.y] * x * z * g.y;
        if (order.z > 0) sum += lz[end.z] * x * y * g.z;
    }
    return sum;
}
