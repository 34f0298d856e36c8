#include "app/editor/tools/point_move.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voledit {

namespace {

constexpr std::array<Vec3, 3> kAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
constexpr std::array<const char*, 3> kAxisNames{"X", "Y", "Z"};

double numberIn(const std::string& typed) {
    double value = 0;
    std::from_chars(typed.data(), typed.data() + typed.size(), value);
    return value;
}

}  // namespace

PointMove::PointMove(const Vec3& anchor, const Camera& camera, Index2 size, const Vec2& pointer)
    : anchor_(anchor), camera_(camera), size_(size), virtual_(pointer), last_(pointer) {
    grab_ = Vec2(project(camera, size, anchor)) - pointer;
}

void PointMove::follow(const Vec2& to, bool slow) {
    virtual_ += (to - last_) * (slow ? 0.1 : 1.0);
    last_ = to;
}

bool PointMove::key(std::string_view key) {
    for (int a = 0; a < 3; ++a)
        if (key == kAxisNames[std::size_t(a)]) {
            axis_ = axis_ == a ? std::nullopt : std::optional<int>(a);
            return true;
        }
    if (key == "Backspace") {
        if (!typed_.empty()) typed_.pop_back();
        return true;
    }
    return key.size() == 1 && type(key[0]);
}

bool PointMove::type(char c) {
    if (c == '-') {
        // The sign turns round wherever it is typed, as a calculator's does.
        if (!typed_.empty() && typed_[0] == '-')
            typed_.erase(0, 1);
        else
            typed_.insert(0, 1, '-');
        return true;
    }
    const bool point = c == '.' && typed_.find('.') == std::string::npos;
    if (!point && !(c >= '0' && c <= '9')) return c == '.';
    if (typed_.size() < 16) typed_ += c;
    return true;
}

Vec3 PointMove::offset() const {
    if (!typed_.empty()) return kAxes[std::size_t(axis_.value_or(0))] * numberIn(typed_);
    const Vec2 pixel = virtual_ + grab_;
    return axis_ ? kAxes[std::size_t(*axis_)] * distanceAlong(*axis_, pixel) : offsetInView(pixel);
}

Vec3 PointMove::offsetInView(const Vec2& pixel) const {
    const Vec3 forward = basisOf(camera_).forward;
    const double depth = glm::dot(anchor_ - camera_.eye, forward);
    const Vec3 ray = rayThrough(camera_, size_, pixel.x - 0.5, pixel.y - 0.5);
    return camera_.eye + ray * (depth / glm::dot(ray, forward)) - anchor_;
}

double PointMove::distanceAlong(int axis, const Vec2& pixel) const {
    const Vec3& along = kAxes[std::size_t(axis)];
    const double depth = project(camera_, size_, anchor_).z;
    const Vec2 start(project(camera_, size_, anchor_));
    // A line is seen as a line, so a second point of it, near enough to be before the eye, gives all of it.
    const Vec2 step = Vec2(project(camera_, size_, anchor_ + along * (0.01 * depth))) - start;
    const double stepSquared = glm::dot(step, step);
    // An axis along the view is seen as a dot: up and down then stand for far and near.
    if (stepSquared < 0.0025) {
        const double away = glm::dot(along, basisOf(camera_).forward) < 0 ? -1 : 1;
        return away * (start.y - pixel.y) * unitsPerPixel();
    }
    const double steps = glm::dot(pixel - start, step) / stepSquared;
    const Vec2 nearest = start + steps * step;
    const Vec3 ray = rayThrough(camera_, size_, nearest.x - 0.5, nearest.y - 0.5);
    const Vec3 w = anchor_ - camera_.eye;
    const double c = glm::dot(ray, along);
    const double distance = (glm::dot(w, ray) * c - glm::dot(w, along)) / (1 - c * c);
    // Past the axis's vanishing point the ray meets it behind the eye, with the other sign.
    const double furthest = 100 * depth;
    if (!(distance * steps >= 0)) return steps > 0 ? furthest : -furthest;
    return std::clamp(distance, -furthest, furthest);
}

double PointMove::unitsPerPixel() const {
    const double depth = project(camera_, size_, anchor_).z;
    return 2 * depth * std::tan(glm::radians(camera_.fovY) / 2) / std::max(1, size_.y);
}

std::string PointMove::readout() const {
    const std::string axisName = axis_ ? std::string(kAxisNames[std::size_t(*axis_)]) + " " : "";
    if (!typed_.empty()) return (axis_ ? axisName : "X ") + typed_ + "_";
    const int decimals = std::clamp(int(std::ceil(-std::log10(std::max(unitsPerPixel(), 1e-9)))), 0, 6);
    const Vec3 by = offset();
    char text[128];
    if (axis_)
        std::snprintf(text, sizeof text, "%.*f", decimals, by[*axis_]);
    else
        std::snprintf(text, sizeof text, "%.*f, %.*f, %.*f", decimals, by.x, decimals, by.y, decimals, by.z);
    return axisName + text;
}

}  // namespace voledit
