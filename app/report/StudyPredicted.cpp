#include "app/report/StudyPredicted.h"

#include <cmath>
#include <optional>

#include "app/report/StudyText.h"
#include "core/analysis/psychophysics/VirtualObserver.h"

namespace tacto {

namespace {

/// Weber fractions of amplitude: half, once and twice the one that is assumed, since 0.10 has no source.
constexpr double kWeberFractions[] = {kAmplitudeWeberFraction / 2, kAmplitudeWeberFraction,
                                      2 * kAmplitudeWeberFraction};

/// As delivered in the test, in the order of the labels; nothing where one of them was not.
std::optional<std::vector<DeliveredCondition>> deliveredIn(const AnalysedSession& one, bool massager) {
    std::vector<DeliveredCondition> all;
    for (const auto& label : one.found.labels) {
        double level = 0, interval_s = 0;
        std::size_t n = 0;
        for (const auto& row : one.session->results.trials) {
            if (row.trial.phase != TrialPhase::Test || row.trial.condition != label) continue;
            level += massager ? row.intensity : row.trial.current.value();
            interval_s += row.trial.interval_s;
            ++n;
        }
        const auto mean = [n](double sum) { return sum / static_cast<double>(n); };
        if (!(level > 0) || !(interval_s > 0) || !std::isfinite(level + interval_s)) return std::nullopt;
        all.push_back({mean(level), Seconds(mean(interval_s))});
    }
    return all;
}

Result<VirtualObserver> personWith(double detection, double weber, bool massager) {
    const double unit = massager ? kVirtualFullIntensity.value() : 1;
    VirtualObserverSettings settings;
    settings.unit = massager ? LevelUnit::Intensity : LevelUnit::Current;
    auto& who = settings.who;
    who.detection = Milliamps(detection * unit);
    // What is named does not depend on these.
    who.attention = who.intolerance = who.discomfort = Milliamps(2 * detection * unit);
    who.amplitudeWeber = weber;
    return VirtualObserver::create(settings);
}

}  // namespace

Result<void> addPredicted(std::vector<ReportBlock>& blocks, Captions& captions, const QString& caption,
                          const AnalysedSession& one, double weber, bool massager) {
    const double detection = one.session->results.detection;
    const auto delivered = deliveredIn(one, massager);
    if (!(detection > 0) || !delivered || delivered->empty()) return {};
    const auto& found = one.found;
    const auto count = found.labels.size();
    TableBlock table;
    table.columns = {{"Presented"}};
    for (const auto& label : found.labels) table.columns.push_back({QString::fromStdString(label), true});
    table.columns.push_back({"none", true});
    table.columns.push_back({"Right, predicted", true});
    table.columns.push_back({"Right, answered", true});
    QStringList accuracies;
    std::vector<double> tried(std::begin(kWeberFractions), std::end(kWeberFractions));
    const bool measured = std::isfinite(weber);
    if (measured) tried.push_back(weber);
    const double inTable = measured ? weber : kAmplitudeWeberFraction;
    for (const double fraction : tried) {
        const auto person = personWith(detection, fraction, massager);
        if (!person) return failure(person);
        const auto shares = person->predicted(*delivered, Seconds(0));
        double right = 0;
        for (std::size_t i = 0; i < count; ++i) right += shares[i][i] / static_cast<double>(count);
        accuracies << QString("%1 % at %2").arg(100 * right, 0, 'f', 0).arg(fraction, 0, 'f', 2);
        if (fraction != inTable) continue;
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t n = 0;
            for (const auto answers : found.confusion[i]) n += answers;
            QStringList row = {QString::fromStdString(found.labels[i])};
            for (const double share : shares[i]) row << QString("%1 %").arg(100 * share, 0, 'f', 0);
            row << QString("%1 %").arg(100 * shares[i][i], 0, 'f', 0)
                << QString("%1 of %2").arg(found.confusion[i][i]).arg(n);
            table.rows.push_back(std::move(row));
        }
    }
    table.caption = captions.table(caption);
    blocks.emplace_back(std::move(table));
    blocks.emplace_back(ParagraphBlock{
        QString(
            "The prediction is a model's with this session's detection threshold, without lapses and drift. All "
            "together it expects %1 as the Weber fraction of amplitude%2. It is shown beside the answers and judges "
            "nothing.")
            .arg(accuracies.join(", "), measured
                                            ? QString(", of which the last was measured and stands in the table")
                                            : QString(", which is not known of this person; 0.10 stands in the table")),
        true});
    return {};
}

}  // namespace tacto
