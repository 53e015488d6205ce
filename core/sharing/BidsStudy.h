// BidsStudy.h - the results of a study as they may leave it: nothing that says who, nothing that says when.
//
// A participant has no code and no date here; days count from the person's first session. A value that was not recorded
// is NaN, an empty text or nothing, and is written as n/a.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/vibration/BurstFigures.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/study/Participant.h"

namespace tacto {

struct BidsTrial {
    IdentificationTrial trial;
    double intensity = kNaN;  ///< a massager's intensity, 0 to 1
    Volts voltage{kNaN};      ///< at `impedance`
    Ohms impedance{kNaN};     ///< measured last before it
    double detection = kNaN;  ///< mA, or a massager's intensity
    bool adapted = false;     ///< asked in a block whose weakest level may not have been felt
    BurstFigures vibration;   ///< what a massager did; NaN where it was not measured
};

/// One presentation of a threshold procedure.
struct BidsThresholdTrial {
    std::size_t number = 0;
    std::string procedure{};  ///< "ascending", "detection", "range", "comparison", "drift"
    std::size_t series = 0;   ///< which ascending series, or the block before which drift was checked; 0: none
    /// "stimulus" or "catch"; with two intervals the right or the stronger one, "first" or "second"
    std::string type{};
    Milliamps current{kNaN};
    double intensity = kNaN;
    double weaker = kNaN;  ///< mA, or intensity, in the other interval of a comparison
    std::string response{};
    std::optional<bool> correct{};  ///< whether the right one of two intervals was chosen
    double response_s = kNaN;
};

struct BidsRating {
    std::string item;       ///< "intensity", "naturalness", ...
    std::string condition;  ///< empty where it is of none
    std::string value;      ///< a number, or words with commas between
};

/// A moment at which side effects are asked for: a later day.
inline constexpr const char* kNextDayMoment = "next day";

struct BidsSideEffect {
    std::string moment;           ///< "before", "after", "next day"
    std::string item;             ///< "tingling", ...
    std::optional<int> severity;  ///< 1 to 4
    std::optional<int> relation;  ///< 1 to 5
};

/// The detection threshold, found again before a block.
struct BidsDrift {
    std::size_t block = 0;
    double detection = kNaN;  ///< mA, or a massager's intensity
    bool adapted = false;
};

struct BidsSession {
    std::size_t number = 0;
    SessionBasis basis = SessionBasis::Person;
    double days = kNaN;  ///< whole days since the person's first session
    std::string encoding;
    std::string answers;  ///< the conditions by their place and key, with commas between
    Ohms impedance{kNaN};
    Milliamps low{kNaN}, high{kNaN};  ///< range
    double lowIntensity = kNaN, highIntensity = kNaN;
    std::string rangeNotUsable;                 ///< why not ("it was not confirmed"); empty where usable or not found
    double detection = kNaN, tooStrong = kNaN;  ///< mA, or a massager's intensity
    bool saidTooStrong = false;                 ///< else `tooStrong` is the highest level given; the limit lies above
    double detectionLow = kNaN, detectionHigh = kNaN;  ///< 95 % interval of `detection`
    double amplitudeWeber = kNaN;                      ///< their own, from a comparison of strengths; NaN at its edge
    std::vector<std::string> sideEffectsAsked;         ///< moments at which they were asked for
    std::optional<int> skinNextDay;                    ///< scored as before and after
    std::optional<int> skinBefore, skinAfter;          ///< the worse of erythema and oedema, 0 to 4
    bool complete = false;
    std::size_t parts = 1;
    std::vector<std::string> labels;  ///< the answers offered, in the study's order
    std::vector<BidsTrial> trials;    ///< familiarisation, training and test, in the order presented
    std::vector<BidsThresholdTrial> thresholds;
    std::vector<BidsDrift> drift;
    std::vector<BidsRating> ratings;
    std::vector<BidsSideEffect> sideEffects;
};

/// Whether there was room for the test between the level just felt and the one too strong.
[[nodiscard]] inline bool hasUsableRange(const BidsSession& session) {
    return session.rangeNotUsable.empty() &&
           (std::isfinite(session.low.value()) || std::isfinite(session.lowIntensity));
}

struct BidsParticipant {
    std::size_t enrolled = 0;                   ///< 1, 2, ...: decides the label together with BidsStudy::labelSeed
    std::string group;                          ///< "intact", "limb difference"
    SessionBasis basis = SessionBasis::Person;  ///< what all their sessions rest on
    std::string age, sex, handedness;           ///< empty where they were not asked for
    std::vector<BidsSession> sessions;
};

struct BidsStudy {
    std::string title;
    bool rehearsal = false;  ///< a rehearsal, which no committee has approved
    std::string approval;    ///< reference and committee; empty: none
    std::string license;     ///< the licence for using the data; empty: not decided
    bool massager = false;   ///< felt through one: levels are intensities, and there are no electrodes
    std::string site;        ///< "upper arm"
    double electrodeArea_cm2 = kNaN;
    /// Participants that the first approval allowed: labels are drawn among as many, and of later ones among as many
    /// again.
    std::size_t places = 0;
    std::uint64_t labelSeed = 0;                ///< a secret of the study; the same at each export
    std::vector<BidsParticipant> participants;  ///< active and those who left; never one who withdrew
};

}  // namespace tacto
