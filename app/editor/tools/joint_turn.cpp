#include "app/editor/tools/joint_turn.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace voledit {

namespace {

constexpr std::array<const char*, 3> kAxisNames{"X", "Y", "Z"};
constexpr double kDegrees = 180 / kPi;
// A ring seen nearly edge on is dragged along, not about: there an angle on the screen says nothing.
constexpr double kEdgeOn = 0.3;

double angleOf(const Vec2& v) {
    return std::atan2(-v.y, v.x) * kDegrees;
}

}  // namespace

JointTurn::JointTurn(const Vec2& pivot, const Vec2& pointer, const Mat3& axes, std::optional<int> lock)
    : pivot_(pivot), axes_(axes), axis_(lock), last_(pointer), reach_(std::max(20.0, glm::distance(pivot, pointer))) {}

void JointTurn::follow(const Vec2& to, bool slow, bool steps) {
    const double share = slow ? 0.1 : 1.0;
    const Vec2 before = last_ - pivot_, after = to - pivot_;
    // At the pivot itself there is no direction.
    if (glm::length(before) > 1 && glm::length(after) > 1)
        swept_ += share * std::remainder(angleOf(after) - angleOf(before), 360.0);
    path_ += share * (to - last_);
    last_ = to;
    slow_ = slow;
    steps_ = steps;
}

bool JointTurn::key(std::string_view key) {
    for (int a = 0; a < 3; ++a)
        if (key == kAxisNames[std::size_t(a)]) {
            axis_ = axis_ == a ? std::nullopt : std::optional<int>(a);
            return true;
        }
    if (key == "Backspace") {
        if (!typed_.empty()) typed_.pop_back();
        return true;
    }
    if (key == "-") {
        // The sign turns round wherever it is typed, as a calculator's does.
        typed_ = typed_.starts_with('-') ? typed_.substr(1) : "-" + typed_;
        return true;
    }
    const bool point = key == ".", digit = key.size() == 1 && key[0] >= '0' && key[0] <= '9';
    if (!point && !digit) return false;
    if (typed_.size() < 12 && !(point && typed_.find('.') != typed_.npos)) typed_ += key;
    return true;
}

double JointTurn::degrees() const {
    if (!typed_.empty()) {
        double value = 0;
        std::from_chars(typed_.data(), typed_.data() + typed_.size(), value);
        return value;
    }
    double degrees = swept_;
    if (axis_) {
        const Vec3& axis = axes_[*axis_];
        if (std::abs(axis.z) < kEdgeOn) {
            // The nearest point of the ring moves along axis × (towards the eye).
            const Vec3 along = glm::cross(axis, Vec3(0, 0, 1));
            degrees = glm::dot(Vec2(path_.x, -path_.y), glm::normalize(Vec2(along))) / reach_ * kDegrees;
        } else if (axis.z < 0) {
            degrees = -degrees;
        }
    }
    const double step = !steps_ ? 0 : slow_ ? 1 : 5;
    return step > 0 ? std::round(degrees / step) * step : degrees;
}

std::string JointTurn::readout() const {
    std::string text = "Rotate ";
    if (axis_) text += std::string(kAxisNames[std::size_t(*axis_)]) + " ";
    if (!typed_.empty()) return text + typed_ + "_°";
    char number[32];
    std::snprintf(number, sizeof number, "%.1f°", degrees());
    return text + number;
}

}  // namespace voledit
