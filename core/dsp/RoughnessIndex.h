// RoughnessIndex.h - features become R: scaled, weighed, smoothed, held when the finger rests.
//
// science.md sections 2.4 (hold and decay), 2.6 and 2.7.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "core/base/Stream.h"
#include "core/dsp/RoughnessSettings.h"

namespace tacto {

enum class Motion { NoContact, Unknown, Resting, Sliding };

class RoughnessIndex {
public:
    /// `period_s` is the time between frames.
    RoughnessIndex(const RoughnessSettings& settings, double period_s) noexcept;

    /// R of the next frame, NaN when absent. `spectral` and `taxel` are NaN when absent.
    [[nodiscard]] double next(double t_s, Motion motion, double spectral, double taxel) noexcept;
    void clear() noexcept { started_ = false; }

    /// Σ w g / Σ w over the features present; NaN with none.
    [[nodiscard]] static double combine(const RoughnessSettings& settings, double spectral, double taxel) noexcept;

    /// R of a whole slide, from the means of its features, and not held within 0..1: a slide over a reference is as
    /// often beyond it as not, and a mean of held values would lie inside. Whoever shows R of a slide, or the mean of
    /// several, holds that within 0..1.
    [[nodiscard]] static double ofSlide(const RoughnessSettings& settings, double spectral, double taxel) noexcept;

private:
    const RoughnessSettings settings_;
    const double alpha_;
    bool started_ = false;
    double held_ = 0;         // the value when sliding last stopped
    double current_ = 0;      // what next() last gave
    double lastSliding_ = 0;  // the time of the last slide
};

// Does the finger slide? Its vibration against the same at rest (science.md section 2.4).
//
// Rest is the declared baseline, else at least 250 ms before the first contact, else the profile's value if its unit
// matches; otherwise every contact frame is taken to slide. Only frames that lie in the rest whole are measured.

class SlidingRest {
public:
    static constexpr double kShortestRest_s = 0.25;
    static constexpr double kFactor = 3;  ///< below this many times the level at rest nothing slides

    /// `profileMeanSquare` only where its unit is the acceleration's. Without acceleration nothing can be measured.
    SlidingRest(bool hasAcceleration, std::optional<TimeInterval> declaredBaseline,
                std::optional<double> profileMeanSquare) noexcept
        : hasAcceleration_(hasAcceleration), declared_(declaredBaseline), profile_(profileMeanSquare) {}

    struct Frame {
        double begin_s, end_s;  ///< the ends of its window
        double meanSquare;      ///< 5 Hz..1 kHz, force normalisation undone
        bool contact;
        double streamBegin_s;   ///< first sample of acceleration
        double firstContact_s;  ///< infinity: not yet
    };
    [[nodiscard]] Motion next(const Frame& frame) noexcept;

    /// No more frames will come: a declared baseline that reaches the end of the data is taken as it is.
    void close() noexcept;
    void clear() noexcept;
    void preset(double meanSquare) noexcept;
    [[nodiscard]] bool decided() const noexcept { return decided_ || !hasAcceleration_; }
    /// True when a contact frame was taken to slide for lack of a rest level.
    [[nodiscard]] bool assumed() const noexcept { return assumed_; }
    /// NaN while unknown or assumed.
    [[nodiscard]] double meanSquare() const noexcept { return level_; }

private:
    struct Sum {
        double total = 0;
        std::size_t count = 0;
        void add(double x) noexcept {
            total += x;
            ++count;
        }
        [[nodiscard]] double mean() const noexcept { return total / static_cast<double>(count); }
    };
    void decide(const Frame& frame) noexcept;

    const bool hasAcceleration_;
    const std::optional<TimeInterval> declared_;
    const std::optional<double> profile_;
    Sum inDeclared_, beforeContact_;
    double level_ = std::numeric_limits<double>::quiet_NaN();
    bool decided_ = false;
    bool preset_ = false;
    bool assumed_ = false;
};

}  // namespace tacto
