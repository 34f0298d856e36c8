#pragma once
// How finely a picture may be drawn so that its frame keeps to a budget. Numbers alone: no clock, no OpenGL.

#include <array>
#include <cstddef>

namespace voledit {

/// How finely a picture is drawn: 1/divisor of the viewport's width and height, steps `step` times as long as the
/// scene's. 1, 1 is full quality.
struct PictureQuality {
    double divisor = 1;
    double step = 1;
    bool operator==(const PictureQuality&) const = default;
};

/// Follows a frame budget by resolution and step, both continuous, joined by one number: the work of a picture, its
/// pixels × samples along a ray, in any unit that the caller keeps to.
///
/// A picture is taken to cost `setup + work · rate`; the rate, the set-up and the rest of the frame are read off the
/// last frames. Quality falls as soon as two of three frames say that it must (one, where it is far too slow), and
/// rises when three in a row say that there is room for a good deal more; between, it stays.
class FrameGovernor {
public:
    /// What one picture took, milliseconds.
    struct Cost {
        double setup = 0;    // before its first pixel; independent of the quality
        double drawing = 0;  // of `work`
        double rest = 0;     // of its frame: everything but the picture
    };

    static constexpr double kCoarsestDivisor = 4;

    /// Nothing is known before the first note().
    bool known() const { return count_ > 0; }
    /// A picture (or that part of one) of `work` was drawn, at the cost said. Work below what was shown may be noted:
    /// a picture tried for its cost.
    void note(double work, const Cost& cost);
    /// The quality for the next picture, of `fullWork` at full quality, in a frame of `budgetMs`. Coarsest where
    /// nothing is known.
    PictureQuality choose(double budgetMs, double fullWork);
    /// Milliseconds that a unit of work usually takes; 0 where nothing is known.
    double rate() const { return sorted(rates_, 0.5); }

private:
    static constexpr std::size_t kFrames = 3;  // that are looked back at
    double drawingBudget(double budgetMs) const;
    double sorted(const std::array<double, kFrames>& values, double place) const;

    std::array<double, kFrames> rates_{}, setups_{}, rests_{};
    std::size_t count_ = 0;  // frames noted
    double share_ = 0;       // of full quality, chosen last; 0: none
};

/// The part of full quality's work that a picture takes: 1 / (divisor² · step).
double shareOfWork(const PictureQuality& quality);
/// The quality that takes this share, of 1 … kCoarsestDivisor; steps grow along with the divisor, a third as fast.
PictureQuality qualityOfShare(double share);

}  // namespace voledit
