#include "app/report/StudyOverSessions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "app/report/StudyText.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Statistics.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

QString withInterval(const Estimate& estimate, int decimals) {
    if (!std::isfinite(estimate.value)) return "–";
    const auto value = figureText(estimate.value, decimals);
    if (!std::isfinite(estimate.low) || !std::isfinite(estimate.high)) return value;
    return QString("%1 (%2 to %3)").arg(value, figureText(estimate.low, decimals), figureText(estimate.high, decimals));
}

/// Returns "12.0", or "> 12.0" if the highest level presented was not called too strong.
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
    table.columns.push_back({"Encoding"});
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
                          << qtext(bitsText(each.itCorrected_bits))
                          << (felt.encoding.empty() ? QString("–") : qtext(felt.encoding));
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

/// Returns the mean over the conditions that were rated with a number; NaN if there are none.
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

Result<void> addOverSessions(std::vector<ReportBlock>& blocks, Captions& captions, const std::string& name,
                             const std::vector<AnalysedSession>& sessions, bool massager) {
    if (sessions.size() < 2) return {};
    const auto compared = compareSessions(sessionFiguresOf(sessions, name, massager));
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

namespace {

struct Preference {
    const char* item;
    const char* title;
};
constexpr Preference kPreferences[] = {{row::kEasier, "Easier to tell"}, {row::kMoreLikeTouch, "More like touch"}};

/// Returns the last answer; empty if no question was asked.
std::string preferredBy(const ParticipantRecord& participant, const char* item) {
    std::string said;
    for (const auto& session : participant.sessions) {
        for (const auto& rating : session.results.ratings) {
            if (rating.item == item && rating.condition.empty()) said = rating.value;
        }
    }
    return said;
}

/// Returns the encodings in the order in which the person used them.
std::vector<std::string> encodingsOf(const ParticipantRecord& participant) {
    std::vector<std::string> had;
    for (const auto& session : participant.sessions) {
        const auto& encoding = session.results.encoding;
        if (!session.results.trials.empty() && std::ranges::find(had, encoding) == had.end()) had.push_back(encoding);
    }
    return had;
}

/// Returns the preferences of all participants who were asked.
std::vector<EncodingPreference> preferencesIn(const StudyRecord& study, const char* item) {
    std::vector<EncodingPreference> all;
    for (const auto& participant : study.participants) {
        if (participant.about.state == ParticipantState::Withdrawn) continue;
        auto said = preferredBy(participant, item);
        if (!said.empty()) all.push_back({encodingsOf(participant), std::move(said)});
    }
    return all;
}

QString encodingText(const std::string& key) {
    return key == row::kNoDifference ? QString("no difference") : QString::fromStdString(key);
}

}  // namespace

QString preferenceText(const ParticipantRecord& participant) {
    QStringList all;
    for (const auto& [item, title] : kPreferences) {
        if (const auto said = preferredBy(participant, item); !said.empty())
            all << QString("%1: %2.").arg(title, encodingText(said));
    }
    return all.join(' ');
}

std::optional<TableBlock> preferencesTable(const StudyRecord& study) {
    std::map<std::string, std::vector<std::size_t>> rows;
    for (std::size_t i = 0; i < std::size(kPreferences); ++i) {
        for (const auto& [encoding, people] : preferences(preferencesIn(study, kPreferences[i].item))) {
            auto& counts = rows[encoding];
            counts.resize(std::size(kPreferences));
            counts[i] = people;
        }
    }
    if (rows.empty()) return std::nullopt;
    rows.try_emplace(row::kNoDifference, std::size(kPreferences), 0U);
    TableBlock table;
    table.columns = {{"Encoding"}};
    for (const auto& each : kPreferences) table.columns.push_back({each.title, true});
    const auto add = [&](const std::string& encoding, const std::vector<std::size_t>& counts) {
        QStringList cells = {encodingText(encoding)};
        for (const auto people : counts) cells << QString::number(people);
        table.rows.push_back(std::move(cells));
    };
    for (const auto& [encoding, counts] : rows) {
        if (encoding != row::kNoDifference) add(encoding, counts);
    }
    add(row::kNoDifference, rows.at(row::kNoDifference));
    return table;
}

QString preferencesNote(const StudyRecord& study) {
    std::map<QString, std::size_t> orders;
    for (const auto& person : preferencesIn(study, row::kEasier)) {
        QStringList names;
        for (const auto& each : person.had) names << QString::fromStdString(each);
        ++orders[names.join(", ")];
    }
    QStringList had;
    bool balanced = orders.size() == williamsRows(study.settings.encodings.size());
    for (const auto& [order, people] : orders) {
        had << QString("%1 participant(s) had %2").arg(people).arg(order);
        balanced = balanced && people == orders.begin()->second;
    }
    return QString(
               "Preferences are shown and not tested: five alike of five people have p = 0.06 (two-sided). In the "
               "order in which they had the encodings: %1.%2")
        .arg(had.join("; "),
             balanced ? "" : " The orders are not balanced, so a preference may be one for what came first or last.");
}

namespace {

/// Weber fractions of amplitude: half, once and twice the assumed fraction, because 0.10 has no source.
constexpr double kWeberFractions[] = {kAmplitudeWeberFraction / 2, kAmplitudeWeberFraction,
                                      2 * kAmplitudeWeberFraction};

/// Returns the conditions as delivered in the test, in the order of the labels; nothing if one was not delivered.
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
    // These thresholds do not affect the answers, which are names of conditions.
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
