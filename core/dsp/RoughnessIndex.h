// RoughnessIndex.h - features become R: scaled, weighed, smoothed, held when the finger rests.
//
// science.md sections 2.4 (hold and decay), 2.6 and 2.7.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

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

    /// The same of a whole slide, from the means of its features, and not held within 0..1: a slide over a reference is
    /// as often beyond it as not, and a mean of held values would lie inside. Who shows R of a slide, or the mean of
    /// several, holds that within 0..1.
    [[nodiscard]] static double ofSlide(const RoughnessSettings& settings, double spectral, double taxel) noexcept;

private:
    const RoughnessSettings settings_;
    const double alpha_;
    bool started_ = false;
    double held_ = 0;         // the value when sliding last stopped
    double current_ = 0;      // what next() last gave
    double lastSliding_ = 0;  // when that was
};

}  // namespace tacto
