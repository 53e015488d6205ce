#include "core/analysis/identification/EncodingsOverPeople.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/analysis/statistics/InformationTransfer.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

/// Returns "+0.12", "-3"; zero has a plus.
std::string signedText(double value, int decimals) {
    const auto text = decimalText(value, decimals);
    return std::isfinite(value) && text.front() != '-' ? '+' + text : text;
}

std::string pointsText(double share) { return signedText(100 * share, 0); }

/// Variance of a proportion by its trials, with two right and two wrong answers added, so that it is never 0 (Agresti &
/// Coull 1998).
double varianceOf(const EncodingResult& result) {
    const double n = static_cast<double>(result.n) + 4, p = (static_cast<double>(result.hits) + 2) / n;
    return p * (1 - p) / n;
}

/// By the longer side of the interval: an end may be cut off at 0, or at the most that can be told apart.
double varianceOf(const Estimate& estimate) {
    static const double kNormal95 = studentQuantile(0.975, std::numeric_limits<double>::infinity());
    return std::pow(std::max(estimate.high - estimate.value, estimate.value - estimate.low) / kNormal95, 2);
}

const EncodingResult* encodingIn(const PersonEncodings& person, const std::string& name) {
    const auto found = std::ranges::find(person.encodings, name, &EncodingResult::encoding);
    return found == person.encodings.end() || found->n == 0 ? nullptr : &*found;
}

/// Share of the 2^n exchanges within people whose summed difference is at least as far from 0.
double exchangeTest(std::span<const double> differences) {
    const std::size_t n = differences.size();
    if (n == 0 || n > kMaxExchanged) return kNaN;
    double observed = 0, size = 0;
    for (const double difference : differences) {
        observed += difference;
        size += std::abs(difference);
    }
    const double enough = std::abs(observed) - 1e-9 * (1 + size);  // equal sums may differ by rounding
    std::size_t asFar = 0;
    const std::size_t ways = std::size_t{1} << n;
    for (std::size_t signs = 0; signs < ways; ++signs) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += (signs >> i & 1U) != 0 ? -differences[i] : differences[i];
        if (std::abs(sum) >= enough) ++asFar;
    }
    return static_cast<double>(asFar) / static_cast<double>(ways);
}

PairOverPeople pairOver(const std::vector<PersonEncodings>& people, const std::string& a, const std::string& b,
                        std::size_t among) {
    PairOverPeople pair;
    pair.a = a;
    pair.b = b;
    std::vector<double> shares, variances, bits, bitVariances;
    for (const auto& person : people) {
        const auto *first = encodingIn(person, a), *second = encodingIn(person, b);
        if (first == nullptr || second == nullptr) continue;
        PersonDifference one;
        one.name = person.name;
        one.accuracy = newcombeDifference(first->hits, first->n, second->hits, second->n);
        one.bits = first->itCorrected_bits.value - second->itCorrected_bits.value;
        one.aFirst = first < second;
        shares.push_back(one.accuracy.value);
        variances.push_back(varianceOf(*first) + varianceOf(*second));
        bits.push_back(one.bits);
        bitVariances.push_back(varianceOf(first->itCorrected_bits) + varianceOf(second->itCorrected_bits));
        pair.aBetter += one.accuracy.value > 0 ? 1 : 0;
        pair.bBetter += one.accuracy.value < 0 ? 1 : 0;
        pair.people.push_back(std::move(one));
    }
    pair.accuracy = meanOverPeople(shares, variances, among);
    pair.bits = meanOverPeople(bits, bitVariances, among);
    pair.exchangeP = exchangeTest(shares);
    return pair;
}

/// Returns the better encoding of a pair; empty if that is not decided.
std::string betterOf(const PairOverPeople& pair) {
    return pair.accuracy.low > 0 ? pair.a : pair.accuracy.high < 0 ? pair.b : std::string();
}

}  // namespace

namespace {

/// Adds the tables of sessions, label by label, and takes the figures of the sum.
void addTables(EncodingResult& result, std::span<const Identification* const> sessions) {
    std::map<std::string, std::map<std::string, std::size_t>> counts;  // presented, answered
    std::set<std::string> columns;
    for (const auto* session : sessions) {
        columns.insert(session->columns.begin(), session->columns.end());
        for (std::size_t i = 0; i < session->labels.size(); ++i) {
            for (std::size_t j = 0; j < session->columns.size(); ++j)
                counts[session->labels[i]][session->columns[j]] += session->confusion[i][j];
        }
    }
    std::vector<std::vector<double>> table;
    for (const auto& [label, row] : counts) {
        auto& cells = table.emplace_back();
        for (const auto& column : columns) {
            const auto cell = row.find(column);
            const std::size_t count = cell == row.end() ? 0 : cell->second;
            cells.push_back(static_cast<double>(count));
            result.n += count;
            if (column == label) result.hits += count;
        }
    }
    result.itCorrected_bits = correctedInformation(table);
}

}  // namespace

std::vector<EncodingResult> encodingResults(std::span<const EncodedSession> sessions) {
    struct Sum {
        EncodingResult result;
        std::vector<const Identification*> tables;
        std::vector<double> times, naturalness;
    };
    std::vector<Sum> sums;
    for (const auto& session : sessions) {
        if (session.encoding.empty() || session.found == nullptr || session.found->all.n == 0) continue;
        auto sum = std::ranges::find(sums, session.encoding, [](const Sum& each) { return each.result.encoding; });
        if (sum == sums.end()) {
            sum = sums.insert(sums.end(), Sum{});
            sum->result.encoding = session.encoding;
        }
        ++sum->result.sessions;
        sum->result.trainingBlocks += session.trainingBlocks;
        sum->tables.push_back(session.found);
        std::ranges::copy(session.response_s, std::back_inserter(sum->times));
        if (std::isfinite(session.naturalness)) sum->naturalness.push_back(session.naturalness);
    }
    std::vector<EncodingResult> all;
    for (auto& sum : sums) {
        addTables(sum.result, sum.tables);
        sum.result.medianResponse_s = statisticsOf(sum.times).median;
        sum.result.naturalness = statisticsOf(sum.naturalness).mean;
        all.push_back(std::move(sum.result));
    }
    return all;
}

Estimate meanOverPeople(std::span<const double> values, std::span<const double> variances, std::size_t among) {
    const auto found = statisticsOf(values);
    if (found.n < 2) return {found.mean, kNaN, kNaN};
    const double n = static_cast<double>(found.n);
    double trials = 0;
    for (const double variance : variances) trials += variance / (n * n);
    const double error = std::sqrt(std::max(found.sd * found.sd / n, trials));
    const double reach = studentQuantile(1 - 0.025 / static_cast<double>(std::max<std::size_t>(among, 1)), n - 1);
    return {found.mean, found.mean - reach * error, found.mean + reach * error};
}

EncodingsOverPeople compareEncodingsOver(std::vector<PersonEncodings> people) {
    EncodingsOverPeople out;
    std::vector<std::string> names;
    for (const auto& person : people) {
        for (const auto& each : person.encodings) {
            if (std::ranges::find(names, each.encoding) == names.end()) names.push_back(each.encoding);
        }
    }
    std::ranges::sort(names);  // not by use: the sign of a difference must not depend on who was enrolled first
    const std::size_t among = names.size() < 2 ? 1 : names.size() * (names.size() - 1) / 2;
    for (std::size_t a = 1; a < names.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            auto pair = pairOver(people, names[a], names[b], among);
            if (!pair.people.empty()) out.pairs.push_back(std::move(pair));
        }
    }
    for (const auto& name : names) {
        const auto wins = std::ranges::count_if(out.pairs, [&](const auto& pair) { return betterOf(pair) == name; });
        if (names.size() > 1 && std::cmp_equal(wins, names.size() - 1)) out.better = name;
    }
    out.people = std::move(people);
    return out;
}

std::vector<std::string> encodingSentences(const EncodingsOverPeople& found) {
    std::vector<std::string> all;
    for (const auto& pair : found.pairs) {
        const auto n = pair.people.size();
        const auto mean = fmt::format("Right answers, {} minus {}: {} percentage points", pair.a, pair.b,
                                      pointsText(pair.accuracy.value));
        if (n == 1) {
            all.push_back(
                fmt::format("Which of {} and {} is better is not decided: only one of the {} had both. {} "
                            "(95 % of that person alone {} to {}).",
                            pair.a, pair.b, found.who, mean, pointsText(pair.people.front().accuracy.low),
                            pointsText(pair.people.front().accuracy.high)));
            continue;
        }
        const auto better = betterOf(pair);
        auto text = better.empty() ? fmt::format("Which of {} and {} is better is not decided", pair.a, pair.b)
                                   : fmt::format("{} is better than {}", better, better == pair.a ? pair.b : pair.a);
        text += fmt::format(
            ". {} within a person (mean of {} {}, 95 % interval {} to {}, t with {} degrees of freedom{}); "
            "{} did better with {}, {} with {}.",
            mean, n, found.who, pointsText(pair.accuracy.low), pointsText(pair.accuracy.high), n - 1,
            found.pairs.size() > 1 ? ", Bonferroni" : "", pair.aBetter, pair.a, pair.bBetter, pair.b);
        text += fmt::format(" Information: {} bit ({} to {}).", signedText(pair.bits.value, 2),
                            signedText(pair.bits.low, 2), signedText(pair.bits.high, 2));
        text += " The interval takes such differences to be normally distributed over people";
        if (std::isfinite(pair.exchangeP))
            text +=
                fmt::format("; without that, exchanging the two within each person gives p = {:.2g}", pair.exchangeP);
        text += n < 6 ? fmt::format(", which {} people cannot bring below {:.2g}.", n, 2 / std::exp2(double(n))) : ".";
        const auto first = static_cast<std::size_t>(
            std::ranges::count_if(pair.people, [](const auto& person) { return person.aFirst; }));
        if (2 * first != n)
            text += fmt::format(" {} of {} had {} first, so practice is part of the difference.",
                                std::max(first, n - first), n, 2 * first > n ? pair.a : pair.b);
        all.push_back(std::move(text));
    }
    return all;
}

std::string assignmentSentence(const EncodingsOverPeople& found) {
    if (found.better == "swapped")
        return "A profile takes it as \"assignment\": \"swapped\": pressure to amplitude, and texture to interval. "
               "This "
               "study takes it alone by an amendment of its \"encodings\".";
    if (found.better == "standard")
        return "It is the assignment of the profile with which the sessions were run. This study takes it alone by an "
               "amendment of its \"encodings\".";
    return {};
}

}  // namespace tacto
