// Procedures.h - grids and virtual participants shared by the tests of procedures.
//
// Thread-safety: pure functions.
#pragma once

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/psychophysics/VirtualObserver.h"

namespace tacto::test {

/// Returns a grid of currents with the device's step and largest value.
inline LevelGrid gridUpTo(double highest, double step = 0.5, LevelLimit by = LevelLimit::Cap) {
    return LevelGrid::create(LevelUnit::Current, step, std::vector<LevelCeiling>{{highest, by}}).value();
}

inline LevelGrid intensities(double step) {
    return LevelGrid::create(LevelUnit::Intensity, step, std::vector<LevelCeiling>{{1, LevelLimit::Device}}).value();
}

inline TrialInterval other(TrialInterval interval) {
    return interval == TrialInterval::First ? TrialInterval::Second : TrialInterval::First;
}

/// Returns the median participant, who feels from 3.06 mA on and finds 8.6 mA too strong, at 200 µs.
inline VirtualParticipant medianParticipant() {
    PopulationModel model;
    for (auto* drawn : {&model.series_ohm, &model.parallel_ohm, &model.capacitance_nf, &model.detection_ma,
                        &model.attention_ma, &model.intolerance_ma, &model.amplitudeWeber, &model.intervalWeber}) {
        drawn->spread = 1;
    }
    auto who = drawParticipant(model, 1, 0, Micros(200));
    who.lapse = 0.02;
    return who;
}

inline VirtualObserver observerFor(const VirtualParticipant& who, std::uint64_t seed, double adaptation = 0) {
    return VirtualObserver::create({.who = who, .seed = seed, .adaptation = adaptation}).value();
}

inline AscendingResult ascend(const LevelGrid& grid, const VirtualObserver& observer, std::uint64_t seed) {
    auto limits = AscendingLimits::create(grid, seed).value();
    while (const auto asked = limits.next()) {
        const auto key = "ascending " + std::to_string(asked->number);
        EXPECT_TRUE(limits.answer(observer.strength(key, asked->level, Seconds(0))));
    }
    return limits.result();
}

/// Answers a procedure of two-interval trials until it ends.
template <class Procedure>
void answerAll(Procedure& procedure, const VirtualObserver& observer, Seconds stimulated = Seconds(0)) {
    while (const auto trial = procedure.next()) {
        const auto key = "detection " + std::to_string(trial->number);
        ASSERT_TRUE(procedure.answer(observer.detect(key, trial->level, trial->interval, stimulated)));
    }
}

}  // namespace tacto::test
