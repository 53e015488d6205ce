// BidsStudy.h - the results of a study in the form in which they may leave it: without names, codes or dates.
//
// Days count from each person's first session. A value that was not recorded is NaN, empty or not set, and is exported
// as n/a.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
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
    Ohms impedance{kNaN};     ///< the last measurement before the trial
    double detection = kNaN;  ///< mA, or a massager's intensity
    bool adapted = false;     ///< the weakest level of the trial's block may not be felt any more
    BurstFigures vibration;   ///< what a massager did; NaN if not measured
};

/// One presentation of a threshold procedure.
struct BidsThresholdTrial {
    std::size_t number = 0;
    std::size_t measurement = 1;  ///< of the range, from 1: it may be measured again
    std::string procedure{};      ///< "ascending", "detection", "range", "comparison" or "drift"
    std::size_t series = 0;       ///< number of the ascending series, or of the block after a drift check; 0: none
    /// "stimulus" or "catch"; with two intervals, the interval with the (stronger) train: "first" or "second"
    std::string type{};
    Milliamps current{kNaN};
    double intensity = kNaN;
    double weaker = kNaN;  ///< level in the other interval of a comparison, in mA or as an intensity
    std::string response{};
    std::optional<bool> correct{};  ///< true if the right interval of two was chosen
    double response_s = kNaN;
};

struct BidsRating {
    std::string item;       ///< "intensity", "naturalness", ...
    std::string condition;  ///< empty if the rating is not about a condition
    std::string value;      ///< a number, or words separated by commas
};

/// A moment at which people are asked for side effects: a later day.
inline constexpr const char* kNextDayMoment = "next day";

struct BidsSideEffect {
    std::string moment;           ///< "before", "after", "next day"
    std::string item;             ///< "tingling", ...
    std::optional<int> severity;  ///< 1 to 4
    std::optional<int> relation;  ///< 1 to 5
};

/// The detection threshold, measured again before a block.
struct BidsDrift {
    std::size_t block = 0;
    double detection = kNaN;  ///< mA, or a massager's intensity
    bool adapted = false;
    double low = kNaN, high = kNaN;  ///< 95 % interval of `detection`
};

struct BidsSession {
    std::size_t number = 0;
    SessionBasis basis = SessionBasis::Person;
    double days = kNaN;  ///< whole days since the person's first session
    std::string encoding;
    std::string answers;              ///< the conditions in the order of the answer places, separated by commas
    Ohms impedance{kNaN};             ///< at the beginning
    Milliamps low{kNaN}, high{kNaN};  ///< the personal range
    Ohms rangeImpedance{kNaN};        ///< when the range was found
    double lowIntensity = kNaN, highIntensity = kNaN;
    std::string rangeNotUsable;                 ///< why not ("it was not confirmed"); empty if usable or not measured
    double detection = kNaN, tooStrong = kNaN;  ///< mA, or a massager's intensity
    double felt = kNaN;                         ///< median of the ascending series' first felt levels
    bool saidTooStrong = false;                 ///< false: `tooStrong` is the highest level given
    double detectionLow = kNaN, detectionHigh = kNaN;  ///< 95 % interval of `detection`
    double amplitudeWeber = kNaN;                      ///< from a comparison of strengths; NaN if it was at its edge
    std::vector<std::string> sideEffectsAsked;         ///< moments at which the participant was asked for side effects
    std::optional<int> skinNextDay;                    ///< scored like skinBefore and skinAfter
    std::optional<int> skinBefore, skinAfter;          ///< the worse of erythema and oedema, 0 to 4
    bool complete = false;
    std::size_t parts = 1;
    std::string deviceModel{}, deviceSerial{};  ///< of what was felt, as recorded; empty if not known
    std::vector<std::string> labels;            ///< the offered answers, in the order of the study
    std::vector<BidsTrial> trials;              ///< familiarisation, training and test, in the order of presentation
    std::vector<BidsThresholdTrial> thresholds;
    std::size_t measurements = 1;  ///< of the range; detection, felt and range are of the last
    std::vector<BidsDrift> drift;
    std::vector<BidsRating> ratings;
    std::vector<BidsSideEffect> sideEffects;
};

/// Whether the levels between just felt and too strong leave enough room for the test.
[[nodiscard]] inline bool hasUsableRange(const BidsSession& session) {
    return session.rangeNotUsable.empty() &&
           (std::isfinite(session.low.value()) || std::isfinite(session.lowIntensity));
}

struct BidsParticipant {
    std::size_t enrolled = 0;                   ///< place in the order of enrolment; with labelSeed decides the label
    std::string group;                          ///< "intact", "limb difference"
    SessionBasis basis = SessionBasis::Person;  ///< basis of all their sessions
    std::string age, sex, handedness;           ///< empty if not asked for
    std::vector<BidsSession> sessions;
};

struct BidsStudy {
    std::string title;
    bool rehearsal = false;  ///< no committee has approved a rehearsal
    std::string approval;    ///< reference and committee; empty: none
    std::string license;     ///< the licence for using the data; empty: not decided
    bool massager = false;   ///< a massager was used: levels are intensities, and there are no electrodes
    std::string site;        ///< "upper arm"
    double electrodeArea_cm2 = kNaN;
    /// Number of participants in the first approval. This many labels are drawn in random order, then the same number
    /// again for later participants.
    std::size_t places = 0;
    std::uint64_t labelSeed = 0;  ///< a secret of the study; the same in each export
    /// What is known of stimulator and electrodes, by the names of BIDS and of the draft NIBS-BIDS: {name, text}.
    std::vector<std::pair<std::string, std::string>> stimulation{};
    std::vector<std::pair<std::string, std::string>> particulars{};  ///< of the study, for people: {label, text}
    std::size_t waiting = 0;  ///< number who are enrolled but not exported: without consent, or without a session
    std::vector<BidsParticipant> participants;  ///< who consented and had a session, and did not withdraw
};

}  // namespace tacto
