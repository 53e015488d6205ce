#include "app/report/StudyVibration.h"

#include "app/report/StudyText.h"
#include "core/analysis/vibration/VibrationSeparability.h"

namespace tacto {

namespace {

std::vector<VibrationTrial> vibrationsOf(const BidsSession& session) {
    std::vector<VibrationTrial> all;
    for (const auto& row : session.trials) {
        if (row.trial.condition == kCatchCondition) continue;
        all.push_back({row.trial.condition, row.intensity, row.trial.interval_s, row.vibration});
    }
    return all;
}

}  // namespace

Result<void> addVibration(std::vector<ReportBlock>& blocks, Captions& captions, const BidsSession& session,
                          const std::string& name) {
    const auto judged = judgeVibration(vibrationsOf(session), session.labels);
    if (!judged) return failure(judged);
    if (!judged->measured) {
        for (const auto& reason : judged->reasons)
            blocks.emplace_back(ParagraphBlock{QString::fromStdString("What the massager did: " + reason)});
        return {};
    }
    TableBlock table;
    table.caption = captions.table(
        QString("%1, session %2: what the motor did, by the accelerometer on it; means over presentations")
            .arg(QString::fromStdString(name))
            .arg(session.number));
    table.columns = {{"Condition"},
                     {"Told: strength", true},
                     {"Told: interval (s)", true},
                     {"Acceleration, RMS (m/s²)", true},
                     {"Interval (s)", true},
                     {"Latency (ms)", true},
                     {"Rise, 10 to 90 % (ms)", true},
                     {"Moved in", true}};
    for (const auto& each : judged->conditions) {
        table.rows.push_back({QString::fromStdString(each.name), figureText(each.intensity, 2),
                              figureText(each.interval_s, 2), figureText(each.strength_m_s2.mean, 2),
                              figureText(each.measuredInterval_s.mean, 3), figureText(1e3 * each.latency_s.mean, 1),
                              figureText(1e3 * each.rise_s.mean, 1),
                              QString("%1 of %2 vibrations").arg(each.moved).arg(each.bursts - each.missed)});
    }
    blocks.emplace_back(std::move(table));
    QString said = QString("Whether the four are apart, by the rule that electrical conditions are judged by: %1.")
                       .arg(QString::fromStdString(std::string(nameOf(judged->verdict))));
    for (const auto& reason : judged->reasons) said += ' ' + QString::fromStdString(reason);
    blocks.emplace_back(ParagraphBlock{said});
    return {};
}

}  // namespace tacto
