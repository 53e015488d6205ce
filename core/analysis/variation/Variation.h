// Variation.h - predicts with virtual participants how well a group of people would tell the conditions apart.
//
// Each participant is drawn at random, gets what the limits allow, and answers as an ideal observer with noise, lapses
// and a threshold. The figures of a participant depend only on the seed and the participant's number and are combined
// in the order of the numbers. The same seed therefore gives the same bits for any number of threads, and a run with n
// participants equals the first n of a larger run.
//
// A condition is valid for a participant if it is presented, felt (at or above the perception threshold) and not too
// strong. A participant with only valid conditions is "served". Distances cover the valid conditions; answers and
// accuracies cover the served participants.
//
// Nothing here is measured. The result is what to expect if people follow the stated distributions.
//
// Thread-safety: predictVariation() uses only its own threads; the other items are plain values.
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
    TrialsWanted wanted;  ///< `conditions` and `chance` are ignored: the encoding sets both
    std::uint64_t seed = 1;
    unsigned threads = 0;  ///< 0: one thread per core; the result does not depend on it
};

struct ParticipantPrediction {
    VirtualParticipant who;
    Delivery delivery;
    std::vector<FeltPoint> points;                 ///< NaN for a condition that is not presented
    std::vector<std::vector<double>> responses;    ///< probabilities, as responseProbabilities()
    std::vector<std::vector<std::size_t>> counts;  ///< sampled, as sampleResponses()
    std::size_t presented = 0;                     ///< number of presented conditions
    bool complete = false;                         ///< true if every condition was presented
    bool served = false;                           ///< true if every condition was presented and is felt
    double accuracy = 0;                           ///< expected accuracy over the presented conditions; NaN without any
    double information = 0;                        ///< expected information transfer, bits; NaN without any
};

struct PredictedPair {
    std::string a;
    std::string b;
    std::size_t participants = 0;  ///< those with both conditions valid; the estimates below are over them
    Estimate jnd;                  ///< distance in both dimensions together: median, 5 and 95 %
    Estimate amplitude_jnd;
    Estimate interval_jnd;
};

struct PredictedCondition {
    std::string name;
    std::size_t presented = 0;  ///< number of participants
    std::size_t refused = 0;
    std::size_t notFelt = 0;  ///< participants who get the condition below their detection threshold
    std::size_t counted = 0;  ///< presented and felt
    /// Numbers of participants, out of all with a known current, whether or not the current is withheld:
    std::size_t drawsAttention = 0;  ///< at or above the attention threshold
    std::size_t tooStrong = 0;       ///< above the level that is too strong for the participant
    std::size_t notTolerated = 0;    ///< above the intolerance threshold
    Estimate current_ma;             ///< over the participants who get the condition
    Estimate voltage_v;
    Estimate interval_s;
};

/// Values are medians over participants; intervals are 5 to 95 %.
struct Variation {
    std::size_t asked = 0;
    std::size_t participants = 0;  ///< number predicted; less than `asked` after a cancel
    bool partial = false;          ///< true if cancelled: only the first `participants` are included
    std::uint64_t seed = 0;

    std::vector<PredictedCondition> conditions;
    std::vector<PredictedPair> pairs;             ///< index of a below index of b
    std::size_t refused = 0;                      ///< pairs of participant and condition that the gate would refuse
    std::size_t notFelt = 0;                      ///< pairs of participant and condition presented below detection
    std::map<std::string, std::size_t> withheld;  ///< pairs not presented, counted by reason

    std::size_t complete = 0;    ///< participants who get every condition
    Estimate presentedAccuracy;  ///< accuracy of these participants, whether or not they feel every condition

    // Every participant belongs to exactly one of these groups:
    std::size_t served = 0;         ///< every condition is valid
    std::size_t refusedPeople = 0;  ///< the gate would refuse at least one condition
    std::size_t unfeltPeople = 0;   ///< every condition is presented but not every one is felt
    std::size_t withoutRange = 0;   ///< no personal amplitude range, or a level that the device cannot set

    std::size_t clearlySeparable = 0;  ///< served participants with every pair at least 5 JND apart in one dimension

    // Over the served participants:
    std::vector<std::vector<std::size_t>> confusion;  ///< sampled, [presented][answered], "none" last
    Estimate accuracy;                                ///< expected accuracy
    Estimate information;                             ///< expected information transfer, bits
    double pooledAccuracy = 0;                        ///< accuracy over the sampled trials; NaN without any
    double pooledInformation = 0;                     ///< information in the sampled trials, bits, not corrected
    double pooledCorrected = 0;                       ///< the same without the chance contribution, bits
    std::vector<double> accuracies;                   ///< sorted accuracies of single participants
    std::optional<TrialsNeeded> trials;               ///< empty without served participants
    std::vector<PilotOutlook> pilots;  ///< for 3, 4, 5 and options.wanted.participants people; empty if none is served

    Estimate impedance_ohm;  ///< over all participants
    Estimate detection_ma;
    Estimate attention_ma;
    Estimate discomfort_ma;
    Estimate intolerance_ma;

    /// The first 1000 participants, so that the result can be recomputed.
    std::vector<ParticipantPrediction> people;
};

/// Called about every 50 ms by the thread that called predictVariation().
using VariationProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Runs the prediction. A stop after the first participant returns the finished participants, marked partial. Errors:
/// InvalidArgument naming the option, its value and what is accepted; Stopped if `stop` was requested before the first
/// participant was done; Unsupported if memory or threads are unavailable.
[[nodiscard]] Result<Variation> predictVariation(const VariationOptions& options, std::stop_token stop = {},
                                                 const VariationProgress& progress = {});

/// Predicts a single participant of the same run.
[[nodiscard]] ParticipantPrediction predictParticipant(const VariationOptions& options, std::size_t index);

}  // namespace tacto
