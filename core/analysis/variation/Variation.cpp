#include "core/analysis/variation/Variation.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/GivenFigure.h"
#include "core/analysis/statistics/InformationTransfer.h"
#include "core/analysis/variation/IndexedWork.h"
#include "core/analysis/variation/VariationBench.h"

namespace tacto {

namespace {

constexpr double kClearlySeparable_jnd = 5;  // science.md section 10
constexpr std::size_t kPeopleKept = 1000;

Result<void> check(const VariationOptions& options) {
    if (auto valid = validate(options.population); !valid) return failure(valid);
    if (auto valid = validate(options.stimulation); !valid) return failure(valid);
    auto valid = checkFigures({givenCount("the number of virtual participants", options.participants, 1, 100'000),
                               givenCount("the number of trials per condition", options.trials, 1, 10'000)});
    if (!valid) return valid;
    return validate(options.wanted);
}

/// Estimates a value over the participants, without those for whom it is NaN.
template <class Value>
Estimate over(std::span<const ParticipantPrediction> people, Value&& value) {
    std::vector<double> values;
    for (const auto& person : people) {
        if (const std::optional<double> known = value(person)) values.push_back(*known);
    }
    return spreadOf(std::move(values));
}

bool presents(const ParticipantPrediction& person, std::size_t condition) {
    return person.delivery.stimuli[condition].outcome == DeliveryOutcome::Presented;
}

/// True if the condition is presented and felt; a condition that is too strong is never presented.
bool counts(const ParticipantPrediction& person, std::size_t condition) {
    return presents(person, condition) && person.delivery.stimuli[condition].felt;
}

PredictedCondition conditionOf(std::span<const ParticipantPrediction> people, const std::string& name, std::size_t i) {
    PredictedCondition out;
    out.name = name;
    for (const auto& person : people) {
        const auto& stimulus = person.delivery.stimuli[i];
        if (isRefused(stimulus.outcome)) ++out.refused;
        if (stimulus.current.value() > 0) {
            if (stimulus.current >= person.who.attention) ++out.drawsAttention;
            if (stimulus.current > person.who.discomfort) ++out.tooStrong;
            if (stimulus.current > person.who.intolerance) ++out.notTolerated;
        }
        if (!presents(person, i)) continue;
        ++out.presented;
        ++(stimulus.felt ? out.counted : out.notFelt);
    }
    const auto presented = [&people, i](auto member) {
        return over(people, [i, member](const ParticipantPrediction& person) -> std::optional<double> {
            if (!presents(person, i)) return std::nullopt;
            return member(person.delivery.stimuli[i]);
        });
    };
    out.current_ma = presented([](const PredictedStimulus& s) { return s.current.value(); });
    out.voltage_v = presented([](const PredictedStimulus& s) { return s.voltage.value(); });
    out.interval_s = presented([](const PredictedStimulus& s) { return s.interval.count(); });
    return out;
}

PredictedPair pairOf(std::span<const ParticipantPrediction> people, const std::vector<Condition>& conditions,
                     std::size_t a, std::size_t b) {
    PredictedPair out;
    out.a = conditions[a].name;
    out.b = conditions[b].name;
    const auto both = [a, b](const ParticipantPrediction& person) { return counts(person, a) && counts(person, b); };
    out.participants = static_cast<std::size_t>(std::ranges::count_if(people, both));
    const auto counted = [&people, &both, a, b](auto distance) {
        return over(people, [&both, a, b, distance](const ParticipantPrediction& person) -> std::optional<double> {
            if (!both(person)) return std::nullopt;
            return distance(person.points[a], person.points[b]);
        });
    };
    out.jnd = counted([](const FeltPoint& x, const FeltPoint& y) { return distance_jnd(x, y); });
    out.amplitude_jnd =
        counted([](const FeltPoint& x, const FeltPoint& y) { return std::abs(x.amplitude_jnd - y.amplitude_jnd); });
    out.interval_jnd =
        counted([](const FeltPoint& x, const FeltPoint& y) { return std::abs(x.interval_jnd - y.interval_jnd); });
    return out;
}

bool isClearlySeparable(const ParticipantPrediction& person) {
    for (std::size_t a = 0; a < person.points.size(); ++a) {
        for (std::size_t b = a + 1; b < person.points.size(); ++b) {
            const auto& x = person.points[a];
            const auto& y = person.points[b];
            if (!(std::abs(x.amplitude_jnd - y.amplitude_jnd) >= kClearlySeparable_jnd ||
                  std::abs(x.interval_jnd - y.interval_jnd) >= kClearlySeparable_jnd)) {
                return false;
            }
        }
    }
    return true;
}

/// Adds the answers of the served participants to the confusion matrix and the accuracies.
void addAnswers(Variation& out, std::span<const ParticipantPrediction> people, std::size_t conditions) {
    out.confusion.assign(conditions, std::vector<std::size_t>(conditions + 1, 0));
    std::size_t right = 0, trials = 0;
    for (const auto& person : people) {
        if (!person.served) continue;
        if (isClearlySeparable(person)) ++out.clearlySeparable;
        out.accuracies.push_back(person.accuracy);
        for (std::size_t i = 0; i < conditions; ++i) {
            for (std::size_t j = 0; j <= conditions; ++j) {
                out.confusion[i][j] += person.counts[i][j];
                trials += person.counts[i][j];
                if (i == j) right += person.counts[i][j];
            }
        }
    }
    const auto of = [&people](auto group, auto member) {
        return over(people, [group, member](const ParticipantPrediction& person) -> std::optional<double> {
            if (!(person.*group)) return std::nullopt;
            return person.*member;
        });
    };
    out.accuracy = of(&ParticipantPrediction::served, &ParticipantPrediction::accuracy);
    out.information = of(&ParticipantPrediction::served, &ParticipantPrediction::information);
    out.presentedAccuracy = of(&ParticipantPrediction::complete, &ParticipantPrediction::accuracy);
    std::ranges::sort(out.accuracies);

    const double n = static_cast<double>(trials);
    out.pooledAccuracy = trials > 0 ? static_cast<double>(right) / n : std::nan("");
    std::vector<std::vector<double>> table;
    for (const auto& row : out.confusion) table.emplace_back(row.begin(), row.end());
    out.pooledInformation = informationTransfer(table);
    out.pooledCorrected = correctedInformation(table).value;
}

/// Puts each participant into one group: served, refused, and so on.
void addPeople(Variation& out, std::span<const ParticipantPrediction> people) {
    for (const auto& person : people) {
        const bool refused = std::ranges::any_of(
            person.delivery.stimuli, [](const PredictedStimulus& stimulus) { return isRefused(stimulus.outcome); });
        if (person.complete) ++out.complete;
        ++(person.served     ? out.served
           : refused         ? out.refusedPeople
           : person.complete ? out.unfeltPeople
                             : out.withoutRange);
    }
}

Variation reduce(const VariationOptions& options, std::span<const ParticipantPrediction> people) {
    const auto& conditions = options.stimulation.encoding.conditions;
    Variation out;
    out.asked = options.participants;
    out.participants = people.size();
    out.partial = people.size() < options.participants;
    out.seed = options.seed;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        out.conditions.push_back(conditionOf(people, conditions[i].name, i));
        out.refused += out.conditions.back().refused;
        out.notFelt += out.conditions.back().notFelt;
        for (const auto& person : people) {
            if (!presents(person, i)) ++out.withheld[person.delivery.stimuli[i].reason];
        }
        for (std::size_t k = i + 1; k < conditions.size(); ++k) out.pairs.push_back(pairOf(people, conditions, i, k));
    }
    addPeople(out, people);
    addAnswers(out, people, conditions.size());
    const auto all = [&people](auto member) {
        return over(people, [member](const ParticipantPrediction& person) { return std::optional(member(person)); });
    };
    out.impedance_ohm = all([](const ParticipantPrediction& p) { return p.delivery.impedance.value(); });
    out.detection_ma = all([](const ParticipantPrediction& p) { return p.who.detection.value(); });
    out.attention_ma = all([](const ParticipantPrediction& p) { return p.who.attention.value(); });
    out.discomfort_ma = all([](const ParticipantPrediction& p) { return p.who.discomfort.value(); });
    out.intolerance_ma = all([](const ParticipantPrediction& p) { return p.who.intolerance.value(); });
    return out;
}

}  // namespace

ParticipantPrediction predictParticipant(const VariationOptions& options, std::size_t index) {
    ParticipantPrediction out;
    out.who = drawParticipant(options.population, options.seed, index, options.stimulation.encoding.train.phaseWidth,
                              options.stimulation.electrodeArea);
    out.delivery = deliverTo(out.who, options.stimulation);
    IdentificationTask task;
    for (const auto& stimulus : out.delivery.stimuli) {
        const bool given = stimulus.outcome == DeliveryOutcome::Presented;
        const double unknown = std::nan("");
        out.points.push_back(given ? feltBy(out.who, stimulus.current.value(), stimulus.interval)
                                   : FeltPoint{unknown, unknown});
        out.presented += given ? 1 : 0;
        task.points.push_back(out.points.back());
        task.given.push_back(given);
    }
    out.complete = out.presented == task.points.size();
    out.served = std::ranges::all_of(out.delivery.stimuli, &PredictedStimulus::felt);
    const auto observer = observerOf(out.who, out.who.detection.value(), options.guess);
    out.responses = responseProbabilities(task, observer);
    Random random(options.seed, fmt::format("answers of virtual participant {}", index));
    out.counts = sampleResponses(task, observer, options.trials, random);
    double right = 0;
    for (std::size_t i = 0; i < task.points.size(); ++i) right += out.responses[i][i];
    out.accuracy = out.presented > 0 ? right / static_cast<double>(out.presented) : std::nan("");
    out.information = informationTransfer(out.responses);
    return out;
}

Result<Variation> predictVariation(const VariationOptions& options, std::stop_token stop,
                                   const VariationProgress& progress) {
    if (auto valid = check(options); !valid) return failure(valid);
    std::vector<ParticipantPrediction> people(options.participants);
    IndexedWork work{options.participants,
                     options.threads,
                     [&](std::size_t index) { people[index] = predictParticipant(options, index); },
                     {}};
    if (progress) work.progress = [&](std::size_t done) { progress(done, options.participants); };
    const auto done = runIndexed(work, std::move(stop));
    if (!done) return failure(done);
    if (*done == 0) return fail(ErrorCode::Stopped, "stopped before the first virtual participant was predicted");
    people.resize(*done);
    Variation out = reduce(options, people);
    if (!out.accuracies.empty()) {
        TrialsWanted wanted = options.wanted;
        wanted.conditions = options.stimulation.encoding.conditions.size();
        wanted.chance = 1 / static_cast<double>(wanted.conditions);
        auto needed = trialsNeeded(out.accuracies, wanted);
        if (!needed) return failure(needed);
        out.trials = std::move(*needed);
        std::vector<std::size_t> sizes = {3, 4, 5};  // sample sizes planned in the paper
        if (wanted.participants < 3 || wanted.participants > 5) sizes.push_back(wanted.participants);
        const PilotPeople group{out.accuracies, out.participants};
        for (const auto size : sizes) {
            out.pilots.push_back(outlookOf(group, size, options.trials * wanted.conditions, wanted.chance));
        }
    }
    people.resize(std::min(people.size(), kPeopleKept));
    out.people = std::move(people);
    return out;
}

}  // namespace tacto
