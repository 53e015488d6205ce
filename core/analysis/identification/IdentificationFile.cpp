#include "core/analysis/identification/IdentificationFile.h"

#include <algorithm>
#include <cmath>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

bool isMissing(std::string_view field) { return field.empty() || field == "n/a"; }

/// Reads a whole number ≥ 1; `fallback` if the column or the value is missing. Errors: ParseError.
Result<std::size_t> countIn(const NamedRows& rows, std::optional<std::size_t> column, std::string_view name,
                            std::size_t fallback) {
    if (!column || isMissing(rows[*column])) return fallback;
    constexpr double kMaxNumber = 1e6;
    const auto number = parseNumber(rows[*column]);
    if (!number || !(*number >= 1) || !(*number <= kMaxNumber) || *number != std::floor(*number)) {
        return rows.refuse("{} '{}'; a whole number from 1 was expected", name, rows[*column].substr(0, 40));
    }
    return static_cast<std::size_t>(*number);
}

}  // namespace

std::vector<IdentificationTrial> ParticipantTrials::trials() const {
    if (sessions.size() == 1) return sessions.front().trials;
    std::vector<IdentificationTrial> all;
    std::size_t before = 0;  // numbers of earlier sessions
    for (const auto& session : sessions) {
        std::size_t last = before;
        for (auto trial : session.trials) {
            trial.number += before;
            last = std::max(last, trial.number);
            all.push_back(std::move(trial));
        }
        before = last;
    }
    return all;
}

Result<std::vector<ParticipantTrials>> readIdentificationTrials(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseIdentificationTrials(*text, path.string());
}

Result<std::vector<ParticipantTrials>> parseIdentificationTrials(std::string_view text, std::string_view name) {
    NamedRows rows(text, name, "columns stimulus and response were expected", "a row per trial");
    const auto condition = rows.column({"stimulus", "condition", "trial_type"});
    if (!condition) return failure(condition);
    const auto response = rows.column({"response"});
    if (!response) return failure(response);
    const auto participant = rows.find({"participant", "participant_id"});
    const auto basis = rows.find({"basis"}), session = rows.find({"session", "session_id"}),
               encoding = rows.find({"encoding"});
    const auto number = rows.find({"number", "trial"}), block = rows.find({"block"}), phase = rows.find({"phase"}),
               attempt = rows.find({"attempt"}), time = rows.find({"response_time", "rt_s"});

    std::vector<ParticipantTrials> people;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        const std::string who(participant ? rows[*participant] : "");
        auto person = std::ranges::find(people, who, &ParticipantTrials::participant);
        if (person == people.end()) person = people.insert(people.end(), {who, {}, {}});
        const std::string on(basis && !isMissing(rows[*basis]) ? rows[*basis] : "");
        if (person->sessions.empty()) person->basis = on;
        if (on != person->basis) {
            return rows.refuse(
                "basis '{}', and rows of '{}' before it have '{}'; one for each participant was expected",
                on.substr(0, 40), who.substr(0, 40), person->basis.substr(0, 40));
        }
        const auto named = [&rows](std::optional<std::size_t> column) {
            return std::string(column && !isMissing(rows[*column]) ? rows[*column] : "");
        };
        const TableSession key{named(session), named(encoding), {}};
        auto of = std::ranges::find_if(person->sessions, [&](const TableSession& each) {
            return each.session == key.session && each.encoding == key.encoding;
        });
        if (of == person->sessions.end()) of = person->sessions.insert(of, key);
        auto& trials = of->trials;
        IdentificationTrial trial;
        trial.condition = std::string(rows[*condition]);
        if (isMissing(trial.condition)) return rows.refuse("the stimulus is empty; a name was expected");
        if (!isMissing(rows[*response])) trial.response = std::string(rows[*response]);
        if (trial.response == "not_sure") trial.response = kNotSureResponse;
        if (phase && !isMissing(rows[*phase])) {
            const auto known = trialPhaseFrom(rows[*phase]);
            if (!known) return rows.refuse("{}", known.error().message);
            trial.phase = *known;
        }
        struct Count {
            std::optional<std::size_t> column;
            std::string_view name;
            std::size_t fallback;
            std::size_t* target;
        };
        for (const auto& count :
             {Count{number, "number", trials.size() + 1, &trial.number}, Count{block, "block", 1, &trial.block},
              Count{attempt, "attempt", 1, &trial.attempt}}) {
            const auto read = countIn(rows, count.column, count.name, count.fallback);
            if (!read) return failure(read);
            *count.target = *read;
        }
        if (time && !isMissing(rows[*time])) {
            const auto seconds = parseNumber(rows[*time]);
            if (!seconds || !(*seconds >= 0) || !std::isfinite(*seconds)) {
                return rows.refuse("response time '{}'; a number of seconds from 0 was expected",
                                   rows[*time].substr(0, 40));
            }
            trial.rt_s = *seconds;
        }
        trials.push_back(std::move(trial));
    }
    if (!more) return failure(more);
    return people;
}

}  // namespace tacto
