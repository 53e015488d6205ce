// Variation.h - how well a group of people would tell the conditions apart: a prediction over virtual participants.
//
// Each participant is drawn, gets what the limits let through, and answers as an ideal observer with noise, lapses and
// a threshold. The figures of a participant depend on the seed and the participant's number alone, and are put
// together in the order of the numbers: the same seed gives the same bits whatever the number of threads, and the
// first n of more participants are those of a run with n.
//
// A condition counts for a participant only if it is presented, felt (at or above the perception threshold) and not too
// strong. A participant for whom every condition counts is served; distances are over conditions that count, answers
// and accuracies over those who are served.
//
// Nothing here is measured: it tells what to expect if people are as the distributions state.
//
// Thread-safety: predictVariation() keeps its threads to itself; the rest are values.
#pragma once

#include <functional>
#include <map>
#include <stop_token>

#include "core/analysis/variation/VariationDelivery.h"
#include "core/analysis/variation/VariationObserver.h"
#include "core/analysis/variation/VariationTrials.h"

namespace tacto {

struct VariationOptions {
    PopulationModel population;
    VirtualStimulation stimulation;
    std::size_t participants = 200;  ///< 1 to 100000
    std::size_t trials = 25;         ///< per condition and participant, 1 to 10000
    GuessBehaviour guess = GuessBehaviour::None;
    TrialsWanted wanted;  ///< `conditions` is the encoding's and `chance` one in so many, whatever stands here
    std::uint64_t seed = 1;
    unsigned threads = 0;  ///< 0: one per core; has no influence on the result
};

struct ParticipantPrediction {
    VirtualParticipant who;
    Delivery delivery;
    std::vector<FeltPoint> points;                 ///< NaN for a condition that is not presented
    std::vector<std::vector<double>> responses;    ///< probabilities, as responseProbabilities()
    std::vector<std::vector<std::size_t>> counts;  ///< sampled, as sampleResponses()
    std::size_t presented = 0;                     ///< conditions
    bool complete = false;                         ///< every condition was presented
    bool served = false;                           ///< ... and is felt
    double accuracy = 0;                           ///< expected, over the presented conditions; NaN without any
    double information = 0;                        ///< expected information transfer, bits; NaN without any
};

struct PredictedPair {
    std::string a;
    std::string b;
    std::size_t participants = 0;  ///< people for whom both count; what follows is over them
    Estimate jnd;                  ///< with both dimensions together: median, 5 and 95 %
    Estimate amplitude_jnd;
    Estimate interval_jnd;
};

struct PredictedCondition {
    std::string name;
    std::size_t presented = 0;  ///< participants
    std::size_t refused = 0;
    std::size_t notFelt = 0;  ///< trials below the detection threshold, among those presented
    std::size_t counted = 0;  ///< presented and felt
    /// Shares of all for whom there is a current, whether or not it is withheld:
    std::size_t drawsAttention = 0;  ///< at or above the attention threshold
    std::size_t tooStrong = 0;       ///< above what is too strong
    std::size_t notTolerated = 0;    ///< above the intolerance threshold
    Estimate current_ma;             ///< over those presented
    Estimate voltage_v;
    Estimate interval_s;
};

/// Intervals are 5 to 95 % over participants, values medians.
struct Variation {
    std::size_t asked = 0;
    std::size_t participants = 0;  ///< predicted; fewer than asked after a cancel
    bool partial = false;          ///< cancelled: the first `participants` of those asked for
    std::uint64_t seed = 0;

    std::vector<PredictedCondition> conditions;
    std::vector<PredictedPair> pairs;             ///< a before b
    std::size_t refused = 0;                      ///< participants times conditions that the gate would refuse
    std::size_t notFelt = 0;                      ///< participants times conditions presented and below detection
    std::map<std::string, std::size_t> withheld;  ///< participants times conditions not presented, by reason

    std::size_t complete = 0;    ///< participants who are presented every condition
    Estimate presentedAccuracy;  ///< accuracy of the complete, whether or not they feel what they are presented

    // Every participant is one of these:
    std::size_t served = 0;         ///< every condition counts
    std::size_t refusedPeople = 0;  ///< the gate would refuse at least one condition
    std::size_t unfeltPeople = 0;   ///< presented every condition, and does not feel all of them
    std::size_t withoutRange = 0;   ///< no range of their own, or a level that the device cannot set

    std::size_t clearlySeparable = 0;  ///< served, with every pair 5 or more JND apart in a dimension

    // Over the served:
    std::vector<std::vector<std::size_t>> confusion;  ///< sampled, [presented][answered], "none" last
    Estimate accuracy;                                ///< expected
    Estimate information;                             ///< expected, bits
    double pooledAccuracy = 0;                        ///< accuracy over the sampled trials; NaN without any
    double pooledInformation = 0;                     ///< information in the sampled trials, bits, not corrected
    double pooledCorrected = 0;                       ///< without the part that chance adds, bits
    std::vector<double> accuracies;                   ///< sorted
    std::optional<TrialsNeeded> trials;               ///< nothing without served participants
    std::vector<PilotOutlook> pilots;  ///< for 3, 4, 5 and options.wanted.participants people; empty likewise

    Estimate impedance_ohm;  ///< over all
    Estimate detection_ma;
    Estimate attention_ma;
    Estimate discomfort_ma;
    Estimate intolerance_ma;

    /// The first 1000, so that it can be computed again.
    std::vector<ParticipantPrediction> people;
};

/// Called about every 50 ms by the thread that called predictVariation().
using VariationProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Errors: InvalidArgument naming the option, its value and what is accepted; Stopped when `stop` was requested before
/// the first participant was done; Unsupported when memory or threads are not to be had. A stop later on gives what is
/// done until then, marked partial.
[[nodiscard]] Result<Variation> predictVariation(const VariationOptions& options, std::stop_token stop = {},
                                                 const VariationProgress& progress = {});

/// One participant of it.
[[nodiscard]] ParticipantPrediction predictParticipant(const VariationOptions& options, std::size_t index);

}  // namespace tacto
