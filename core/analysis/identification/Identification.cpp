#include "core/analysis/identification/Identification.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/analysis/identification/OverSessions.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/analysis/statistics/InformationTransfer.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

using Counts = std::vector<std::vector<std::size_t>>;

bool isReserved(std::string_view name) {
    return name == kCatchCondition || name == kNoneResponse || name == kNotSureResponse;
}

std::optional<std::size_t> indexOf(const std::vector<std::string>& names, std::string_view name) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names.begin());
}

/// Appends to `met` the further names from test trials, in the order of first appearance.
std::vector<std::string> namesMet(std::span<const IdentificationTrial> trials, std::string IdentificationTrial::*name,
                                  std::vector<std::string> met) {
    for (const auto& trial : trials) {
        const auto& text = trial.*name;
        if (trial.phase != TrialPhase::Test || text.empty() || text == kCatchCondition) continue;
        if (!indexOf(met, text)) met.push_back(text);
    }
    return met;
}

Result<void> checkLabels(const std::vector<std::string>& labels) {
    if (labels.size() < 2) {
        return invalid("{} condition(s); at least two are needed to tell apart", labels.size());
    }
    for (const auto& label : labels) {
        if (label.empty() || isReserved(label)) {
            return invalid("a condition is named \"{}\"; a name other than catch, none and not-sure is accepted",
                           label);
        }
    }
    if (const auto* second = secondIn(labels)) return invalid("{}", givenTwice("the condition \"{}\"", *second));
    return {};
}

/// Checks that all conditions and answers are known; otherwise a misspelt answer would be counted as wrong.
Result<void> checkTrials(std::span<const IdentificationTrial> trials, const std::vector<std::string>& labels,
                         const std::vector<std::string>& columns) {
    std::set<std::size_t> answered;
    for (const auto& trial : trials) {
        if (trial.phase != TrialPhase::Test) continue;
        if (trial.condition != kCatchCondition && !indexOf(labels, trial.condition)) {
            return invalid("trial {} presents \"{}\"; {} or catch was expected", trial.number, trial.condition,
                           fmt::join(labels, ", "));
        }
        if (trial.response.empty()) continue;
        if (!indexOf(columns, trial.response) || trial.response == kCatchCondition) {
            return invalid("trial {} was answered \"{}\"; {} was expected", trial.number, trial.response,
                           fmt::join(columns, ", "));
        }
        if (!answered.insert(trial.number).second)
            return invalid("{}", givenTwice("the answer of trial {}", trial.number));
    }
    return {};
}

/// Right answers lie on the diagonal. `names`: number of labels offered, without "none" and "not sure".
ConfusionFigures figuresOf(const Counts& counts, std::size_t names) {
    ConfusionFigures out;
    std::vector<std::vector<double>> table;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        table.emplace_back(counts[i].begin(), counts[i].end());
        for (const std::size_t n : counts[i]) out.n += n;
        out.hits += counts[i][i];
    }
    out.chance = 1 / static_cast<double>(names);
    out.accuracy = wilsonInterval(out.hits, out.n);
    out.pChance = binomialAtLeast(out.hits, out.n, out.chance);
    out.it_bits = informationTransfer(table);
    out.itCorrected_bits = correctedInformation(table);
    return out;
}

/// z of the rate `k` / `n`, with half an answer added to each cell so that z is finite.
double standardScore(std::size_t k, std::size_t n) {
    constexpr double kNormal = std::numeric_limits<double>::infinity();
    const double rate = (static_cast<double>(k) + 0.5) / (static_cast<double>(n) + 1);
    return rate == 0.5 ? 0 : studentQuantile(rate, kNormal);
}

/// Merges the table of labels into a table of one feature.
FeatureFigures mergedBy(std::string_view LabelFeatures::*value, const Identification& found) {
    FeatureFigures out;
    std::vector<std::size_t> rowOf;
    for (const auto& label : found.labels) {
        const auto name = featuresOf(label).*value;
        if (!indexOf(out.values, name)) out.values.emplace_back(name);
        rowOf.push_back(*indexOf(out.values, name));
    }
    const std::size_t values = out.values.size(), labels = found.labels.size(), columns = found.columns.size();
    out.confusion.assign(values, std::vector<std::size_t>(values + columns - labels, 0));
    for (std::size_t i = 0; i < labels; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            const std::size_t column = j < labels ? rowOf[j] : values + j - labels;
            out.confusion[rowOf[i]][column] += found.confusion[i][j];
        }
    }
    out.figures = figuresOf(out.confusion, values);
    const auto& counts = out.confusion;
    const std::size_t signal = counts[0][0] + counts[0][1], noise = counts[1][0] + counts[1][1];
    if (signal > 0 && noise > 0) {
        const double hit = standardScore(counts[0][0], signal), falseAlarm = standardScore(counts[1][0], noise);
        out.dPrime = hit - falseAlarm;
        out.criterion = -(hit + falseAlarm) / 2;
    }
    return out;
}

bool areTwoByTwo(const std::vector<std::string>& labels) {
    std::set<std::string_view> textures, pressures;
    for (const auto& label : labels) {
        const auto features = featuresOf(label);
        if (features.pressure.empty()) return false;
        textures.insert(features.texture);
        pressures.insert(features.pressure);
    }
    return labels.size() == 4 && textures.size() == 2 && pressures.size() == 2;  // no two are equal, so all exist
}

/// Adds the answered test trials in their order, without catch trials.
void addTrials(Identification& out, std::span<const IdentificationTrial> trials) {
    std::map<std::size_t, BlockFigures> blocks;
    std::vector<std::vector<double>> times(out.labels.size());
    const IdentificationTrial* before = nullptr;
    for (const auto& trial : trials) {
        if (trial.phase != TrialPhase::Test || trial.response.empty()) continue;
        const auto row = indexOf(out.labels, trial.condition);
        const IdentificationTrial* const previous = std::exchange(before, row ? &trial : nullptr);
        if (!row) {
            ++out.catches.n;
            if (!isReserved(trial.response)) ++out.catches.falseAlarms;
            continue;
        }
        ++out.confusion[*row][*indexOf(out.columns, trial.response)];
        const std::size_t hit = trial.condition == trial.response ? 1 : 0;
        auto& block = blocks[trial.block];
        block.block = trial.block;
        ++block.n;
        block.hits += hit;
        if (std::isfinite(trial.rt_s)) times[*row].push_back(trial.rt_s);
        if (previous != nullptr && previous->block == trial.block) {
            auto& after = previous->condition == trial.condition ? out.afterSame : out.afterOther;
            ++after.n;
            after.hits += hit;
        }
    }
    for (const auto& [number, block] : blocks) out.blocks.push_back(block);
    for (const auto& row : times) out.medianResponseTime_s.push_back(statisticsOf(row).median);
}

/// Number of test trials without an answer in any attempt.
std::size_t unanswered(std::span<const IdentificationTrial> trials) {
    std::map<std::size_t, bool> answered;
    for (const auto& trial : trials) {
        if (trial.phase == TrialPhase::Test) answered[trial.number] |= !trial.response.empty();
    }
    return static_cast<std::size_t>(std::ranges::count_if(answered, [](const auto& trial) { return !trial.second; }));
}

Result<Identification> analysed(std::span<const IdentificationTrial> trials, std::vector<std::string> labels,
                                std::vector<std::string> columns) {
    Identification out;
    out.labels = std::move(labels);
    out.columns = std::move(columns);
    if (auto sane = checkLabels(out.labels); !sane) return failure(sane);
    if (auto sane = checkTrials(trials, out.labels, out.columns); !sane) return failure(sane);
    out.confusion.assign(out.labels.size(), std::vector<std::size_t>(out.columns.size(), 0));
    addTrials(out, trials);
    out.noAnswer = unanswered(trials);
    const auto isName = [](const std::string& column) { return !isReserved(column); };
    out.all = figuresOf(out.confusion, static_cast<std::size_t>(std::ranges::count_if(out.columns, isName)));
    out.catches.rate = clopperPearsonInterval(out.catches.falseAlarms, out.catches.n);
    if (areTwoByTwo(out.labels)) {
        out.texture = mergedBy(&LabelFeatures::texture, out);
        out.pressure = mergedBy(&LabelFeatures::pressure, out);
    }
    for (std::size_t j = 0; j < out.columns.size(); ++j) {
        std::size_t given = 0;
        for (const auto& row : out.confusion) given += row[j];
        out.shares.push_back({out.columns[j], given, wilsonInterval(given, out.all.n)});
    }
    std::vector<LogisticPoint> points;
    for (const auto& block : out.blocks) points.push_back({static_cast<double>(block.block), block.n, block.hits});
    out.learning = logisticSlope(points);
    return out;
}

}  // namespace

Result<Identification> identify(std::span<const IdentificationTrial> trials, std::vector<std::string> labels) {
    auto columns = labels;
    columns.emplace_back(kNoneResponse);
    columns.emplace_back(kNotSureResponse);
    return analysed(trials, std::move(labels), std::move(columns));
}

Result<Identification> identifyAsMet(std::span<const IdentificationTrial> trials) {
    auto labels = namesMet(trials, &IdentificationTrial::condition, {});
    auto columns = namesMet(trials, &IdentificationTrial::response, labels);
    return analysed(trials, std::move(labels), std::move(columns));
}

Result<TrialPhase> trialPhaseFrom(std::string_view name) {
    if (const auto known = valueFor(kTrialPhases, name)) return *known;
    return invalid("the phase is \"{}\"; familiarisation, training or test is accepted", name);
}

LabelFeatures featuresOf(std::string_view label) noexcept {
    const auto hyphen = label.find('-');
    if (hyphen == std::string_view::npos) return {label, {}};
    return {label.substr(0, hyphen), label.substr(hyphen + 1)};
}

}  // namespace tacto
