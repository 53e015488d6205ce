// PersonFixture.h - a bench for a virtual participant: a current source with steps of 0.5 mA, and skin as load.
//
// Thread-safety: the test's own thread; the bench has its own rules.
#pragma once

#include "tests/bench/BenchFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {

class PersonFixture : public BenchFixture {
protected:
    static constexpr Seconds kShortest{0.5};

    PersonFixture() {
        person_ = PersonSetup{.participant = "P-7K3M",
                              .consentRecorded = true,
                              .discomfortLimit = Milliamps(20),
                              .rampStep = Milliamps(1),
                              .cap = Milliamps(15),
                              .impedanceLow = Ohms(500),
                              .impedanceHigh = Ohms(10'000)};
        profile_.electrodeArea = SquareCentimetres(3);
    }

    /// `more`: additional keys of the stimulator's address.
    void openPerson(const std::string& more = "", bool realTime = false) {
        open({"sim:stimulator?mode=current&step=0.5mA" + more}, {Role::Stimulator}, realTime, skin_);
    }
    void openArmed(const std::string& more = "", bool realTime = false) {
        openPerson(more, realTime);
        accepted(arm(skin_));
    }
    [[nodiscard]] Presented presentTest(double mA, double interval_s = 0.5, double window_s = 1) {
        auto presented = bench_->present(testPresentation(Milliamps(mA), Seconds(interval_s), Seconds(window_s)));
        EXPECT_TRUE(presented) << presented.error().message;
        return presented ? std::move(*presented) : Presented{};
    }
    /// Raises the level from 0.5 mA; each level is presented and accepted.
    void rampTo(double mA) {
        for (double level = 0.5; level <= mA; level += 0.5) {
            const auto presented = accepted(bench_->present(ascendingPresentation(Milliamps(level), kShortest)));
            ASSERT_EQ(presented.end, PresentationEnd::Complete) << level << ": " << presented.reason;
            accepted(bench_->accept(Milliamps(level)));
        }
    }

    std::string skin_ = "200 ohm + (3 kohm || 20 nF)";
};

}  // namespace tacto::test
