#include "app/report/StudyPreferences.h"

#include <algorithm>
#include <map>

#include "core/analysis/identification/OverSessions.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

struct Preference {
    const char* item;
    const char* title;
};
constexpr Preference kPreferences[] = {{row::kEasier, "Easier to tell"}, {row::kMoreLikeTouch, "More like touch"}};

/// What was said last; empty where it was not asked.
std::string preferredBy(const ParticipantRecord& participant, const char* item) {
    std::string said;
    for (const auto& session : participant.sessions) {
        for (const auto& rating : session.results.ratings) {
            if (rating.item == item && rating.condition.empty()) said = rating.value;
        }
    }
    return said;
}

/// In the order in which the person had them.
std::vector<EncodingResult> encodingsOf(const ParticipantRecord& participant) {
    std::vector<EncodingResult> had;
    for (const auto& session : participant.sessions) {
        const auto& encoding = session.results.encoding;
        if (session.results.trials.empty()) continue;
        if (std::ranges::find(had, encoding, &EncodingResult::encoding) == had.end())
            had.push_back({.encoding = encoding});
    }
    return had;
}

/// Comparisons by the participants who were asked.
std::vector<EncodingComparison> comparisons(const StudyRecord& study, const char* item) {
    std::vector<EncodingComparison> all;
    for (const auto& participant : study.participants) {
        if (participant.about.state == ParticipantState::Withdrawn) continue;
        auto said = preferredBy(participant, item);
        if (!said.empty()) all.push_back(compareEncodings(encodingsOf(participant), std::move(said)));
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
        for (const auto& [encoding, people] : preferences(comparisons(study, kPreferences[i].item))) {
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
    for (const auto& person : comparisons(study, row::kEasier)) {
        QStringList names;
        for (const auto& each : person.encodings) names << QString::fromStdString(each.encoding);
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

}  // namespace tacto
