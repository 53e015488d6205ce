// RoughnessIndex.h - computes R from features: scales, weighs and smooths them, and holds R when the finger rests.
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
    /// `period_s`: the time between frames.
    RoughnessIndex(const RoughnessSettings& settings, double period_s) noexcept;

    /// Returns R of the next frame; NaN if absent. `spectral` and `taxel` are NaN if absent.
    [[nodiscard]] double next(double t_s, Motion motion, double spectral, double taxel) noexcept;
    void clear() noexcept { started_ = false; }

    /// Returns Σ w g / Σ w over the features present; NaN if there are none.
    [[nodiscard]] static double combine(const RoughnessSettings& settings, double spectral, double taxel) noexcept;

    /// Returns R of a whole slide, from the means of its features, not limited to 0..1. A slide over a reference
    /// surface lies beyond the reference as often as not, so a mean of limited values would be biased inwards. Limit R
    /// of a slide, or the mean of several, to 0..1 only for display.
    [[nodiscard]] static double ofSlide(const RoughnessSettings& settings, double spectral, double taxel) noexcept;

private:
    const RoughnessSettings settings_;
    const double alpha_;
    bool started_ = false;
    double held_ = 0;         // value when sliding last stopped
    double current_ = 0;      // last value from next()
    double lastSliding_ = 0;  // time of the last slide
};

// Decides whether the finger slides: compares its vibration with the vibration at rest (science.md section 2.4).
//
// Rest is the declared baseline; else at least 250 ms before the first contact; else the profile's value if its unit
// matches. Otherwise every contact frame is assumed to slide. Only frames completely within the rest are measured.

class SlidingRest {
public:
    static constexpr double kShortestRest_s = 0.25;
    static constexpr double kFactor = 3;  ///< times the level at rest: with less vibration nothing slides

    /// Give `profileMeanSquare` only in the acceleration's unit. Without acceleration nothing can be measured.
    SlidingRest(bool hasAcceleration, std::optional<TimeInterval> declaredBaseline,
                std::optional<double> profileMeanSquare) noexcept
        : hasAcceleration_(hasAcceleration), declared_(declaredBaseline), profile_(profileMeanSquare) {}

    struct Frame {
        double begin_s, end_s;  ///< start and end of the frame's window
        double meanSquare;      ///< 5 Hz..1 kHz, with the force normalisation undone
        bool contact;
        double streamBegin_s;   ///< time of the first acceleration sample
        double firstContact_s;  ///< infinity: no contact yet
    };
    [[nodiscard]] Motion next(const Frame& frame) noexcept;

    /// Ends the input: a declared baseline that reaches the end of the data is used as it is.
    void close() noexcept;
    void clear() noexcept;
    void preset(double meanSquare) noexcept;
    [[nodiscard]] bool decided() const noexcept { return decided_ || !hasAcceleration_; }
    /// Returns true if a contact frame was assumed to slide because there was no rest level.
    [[nodiscard]] bool assumed() const noexcept { return assumed_; }
    /// Returns the level at rest; NaN while unknown or assumed.
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
