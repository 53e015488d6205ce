#include "app/report/StudyOverSessions.h"

#include <cmath>

#include "app/report/StudyText.h"
#include "core/analysis/identification/OverSessions.h"

namespace tacto {

Result<void> addOverSessions(std::vector<ReportBlock>& blocks, Captions& captions, const std::string& name,
                             const std::vector<AnalysedSession>& sessions, bool massager) {
    if (sessions.size() < 2) return {};
    std::vector<SessionFigures> figures;
    for (const auto& one : sessions) {
        const auto& results = one.session->results;
        figures.push_back({.number = results.number,
                           .days = results.days,
                           .detection_ma = {massager ? kNaN : results.detection, kNaN, kNaN},
                           .n = one.found.all.n,
                           .hits = one.found.all.hits,
                           .itCorrected_bits = one.found.all.itCorrected_bits});
    }
    const auto compared = compareSessions(std::move(figures));
    if (!compared) return failure(compared);
    TableBlock table;
    table.caption = captions.table(QString::fromStdString(name) + " over sessions");
    table.columns = {{"Session", true}, {"Day", true}};
    for (const char* level : {"Detection", "Too strong", "Range"})
        table.columns.push_back({QString("%1 (%2)").arg(QString(level), QString(massager ? "strength" : "mA")), true});
    if (!massager) table.columns.push_back({"|Z| (Ω)", true});
    table.columns.push_back({"Right", true});
    table.columns.push_back({"Against the first", true});
    const int digits = massager ? 2 : 1;
    for (std::size_t i = 0; i < compared->sessions.size(); ++i) {
        const auto& each = compared->sessions[i];
        const auto& felt = sessions[i].session->results;
        const double low = massager ? felt.lowIntensity : felt.low.value();
        const double high = massager ? felt.highIntensity : felt.high.value();
        table.rows.push_back({QString::number(each.number), figureText(each.days, 0), figureText(felt.detection, 2),
                              figureText(felt.tooStrong, digits),
                              figureText(low, digits) + " to " + figureText(high, digits)});
        if (!massager) table.rows.back() << figureText(felt.impedance.value(), 0);
        table.rows.back() << QString("%1 of %2").arg(each.hits).arg(each.n)
                          << (i == 0 ? QString("–") : shareText(compared->againstFirst[i - 1].accuracy));
    }
    blocks.emplace_back(std::move(table));
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
