#include "app/report/StudyOverSessions.h"

#include <algorithm>
#include <cmath>

#include "app/report/StudyText.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/base/Statistics.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

double highestOf(const BidsSession& felt, bool massager) { return massager ? felt.highIntensity : felt.high.value(); }

QString withInterval(const Estimate& estimate, int decimals) {
    if (!std::isfinite(estimate.value)) return "–";
    const auto value = figureText(estimate.value, decimals);
    if (!std::isfinite(estimate.low) || !std::isfinite(estimate.high)) return value;
    return QString("%1 (%2 to %3)").arg(value, figureText(estimate.low, decimals), figureText(estimate.high, decimals));
}

std::vector<SessionFigures> figuresOf(const std::vector<AnalysedSession>& sessions, bool massager) {
    std::vector<SessionFigures> figures;
    for (const auto& one : sessions) {
        const auto& felt = one.session->results;
        figures.push_back({.number = felt.number,
                           .days = felt.days,
                           .detection = {felt.detection, felt.detectionLow, felt.detectionHigh},
                           .tooStrong = felt.saidTooStrong ? felt.tooStrong : kNaN,
                           .high = highestOf(felt, massager),
                           .impedance = felt.impedance,
                           .n = one.found.all.n,
                           .hits = one.found.all.hits,
                           .itCorrected_bits = one.found.all.itCorrected_bits});
    }
    return figures;
}

/// "12.0"; "> 12.0" where the highest that was given was not called too strong.
QString tooStrongText(const BidsSession& felt, int digits) {
    const auto level = figureText(felt.tooStrong, digits);
    return felt.saidTooStrong || !std::isfinite(felt.tooStrong) ? level : "> " + level;
}

TableBlock valuesTable(const OverSessions& compared, const std::vector<AnalysedSession>& sessions, bool massager) {
    TableBlock table;
    table.columns = {{"Session", true}, {"Day", true}};
    for (const char* level : {"Detection", "Too strong", "Range"})
        table.columns.push_back({QString("%1 (%2)").arg(QString(level), QString(massager ? "strength" : "mA")), true});
    if (!massager) table.columns.push_back({"|Z| (Ω)", true});
    table.columns.push_back({"Right", true});
    table.columns.push_back({"Information, corrected, 95 % (bit)", true});
    const int digits = massager ? 2 : 1;
    for (std::size_t i = 0; i < compared.sessions.size(); ++i) {
        const auto& each = compared.sessions[i];
        const auto& felt = sessions[i].session->results;
        const double low = massager ? felt.lowIntensity : felt.low.value();
        const auto range = hasUsableRange(felt) && std::isfinite(each.high)
                               ? figureText(low, digits) + " to " + figureText(each.high, digits)
                               : QString("–");
        table.rows.push_back({QString::number(each.number), figureText(each.days, 0), withInterval(each.detection, 2),
                              tooStrongText(felt, digits), range});
        if (!massager) table.rows.back() << figureText(each.impedance.value(), 0);
        table.rows.back() << (each.n == 0 ? QString("–") : QString("%1 of %2").arg(each.hits).arg(each.n))
                          << qtext(bitsText(each.itCorrected_bits));
    }
    return table;
}

TableBlock changesTable(const OverSessions& compared, bool massager) {
    TableBlock table;
    table.columns = {{"Session", true},
                     {"Right, minus that of the first (percentage points)", true},
                     {"Detection, ratio", true},
                     {"Too strong", true},
                     {"Highest of the range", true}};
    if (!massager) table.columns.push_back({"|Z|", true});
    for (const auto& change : compared.againstFirst) {
        table.rows.push_back({QString::number(change.number), shareText(change.accuracy).remove(" %"),
                              withInterval(change.detection, 2), figureText(change.tooStrong, 2),
                              figureText(change.high, 2)});
        if (!massager) table.rows.back() << figureText(change.impedance, 2);
    }
    return table;
}

/// Mean over the conditions that were rated with a number; NaN for none.
double meanRating(const BidsSession& session, std::string_view item) {
    std::vector<double> values;
    for (const auto& rating : session.ratings) {
        if (rating.item != item) continue;
        if (const auto value = parseNumber(rating.value)) values.push_back(*value);
    }
    return statisticsOf(values).mean;
}

bool isRated(const AnalysedSession& one) {
    return std::isfinite(meanRating(one.session->results, "intensity")) ||
           std::isfinite(naturalnessOf(one.session->results));
}

TableBlock ratingsTable(const std::vector<AnalysedSession>& sessions) {
    TableBlock table;
    table.columns = {{"Session", true},
                     {"Intensity, 0 to 10", true},
                     {"Unpleasantness, 0 to 10", true},
                     {"Pain, 0 to 10", true},
                     {"Naturalness, 1 to 5", true}};
    for (const auto& one : sessions) {
        const auto& felt = one.session->results;
        table.rows.push_back({QString::number(felt.number)});
        for (const char* item : {"intensity", "unpleasantness", "pain"})
            table.rows.back() << figureText(meanRating(felt, item), 1);
        table.rows.back() << figureText(naturalnessOf(felt), 1);
    }
    return table;
}

}  // namespace

double naturalnessOf(const BidsSession& session) {
    constexpr std::string_view kWords[] = {"totally-unnatural", "rather-unnatural", "possibly-natural",
                                           "almost-natural", "totally-natural"};
    std::vector<double> scores;
    for (const auto& rating : session.ratings) {
        const auto word = std::ranges::find(kWords, rating.value);
        if (rating.item == "naturalness" && word != std::end(kWords))
            scores.push_back(static_cast<double>(word - std::begin(kWords) + 1));
    }
    return statisticsOf(scores).mean;
}

Result<void> addOverSessions(std::vector<ReportBlock>& blocks, Captions& captions, const std::string& name,
                             const std::vector<AnalysedSession>& sessions, bool massager) {
    if (sessions.size() < 2) return {};
    const auto compared = compareSessions(figuresOf(sessions, massager));
    if (!compared) return failure(compared);
    const auto who = QString::fromStdString(name);
    const auto add = [&](TableBlock table, const QString& caption) {
        table.caption = captions.table(who + caption);
        blocks.emplace_back(std::move(table));
    };
    add(valuesTable(*compared, sessions, massager), " over sessions");
    add(changesTable(*compared, massager), " over sessions, each against the first that has the figure");
    if (std::ranges::any_of(sessions, isRated)) add(ratingsTable(sessions), " over sessions: mean ratings");
    if (!std::isfinite(compared->smallestChange)) return {};
    blocks.emplace_back(ParagraphBlock{QString("Two such sessions can show a change of %1 percentage points or more.")
                                           .arg(100 * compared->smallestChange, 0, 'f', 0)});
    if (std::isfinite(compared->trend.value)) {
        const auto& trend = compared->trend;
        blocks.emplace_back(
            ParagraphBlock{QString("Trend: %1 (%2 to %3) in log odds per day.")
                               .arg(figureText(trend.value, 3), figureText(trend.low, 3), figureText(trend.high, 3))});
    }
    return {};
}

}  // namespace tacto
