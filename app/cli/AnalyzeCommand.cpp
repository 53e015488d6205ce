#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/drift/Drift.h"
#include "core/analysis/identification/IdentificationFile.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/study/Participant.h"

namespace tacto::cli {

namespace {

void declareAnalyze(QCommandLineParser& parser) {
    parser.addOption(
        {"basis",
         "For identification: on whom the answers rest, where no column \"basis\" says it: person, \"person "
         "on simulated devices\" or \"virtual participant\".",
         "BASIS"});
    parser.addOption({"json", "Prints one JSON value."});
}

/// Judges a table of trials with `judge`.
template <class Judge>
int trials(const std::string& kind, const std::string& file, bool asJson, Judge&& judge) {
    const auto read = readSeparabilityTrials(file);
    if (!read) return couldNotRun(read.error());
    const auto found = judge(*read);
    if (!found) return couldNotRun(Error{found.error().code, fmt::format("{}: {}", file, found.error().message)});
    const auto result = toJson(*found);
    if (asJson) {
        printJson(result);
    } else {
        printTables(kind, result);
        printVerdict(nameOf(found->verdict), found->reasons);
    }
    return exitForVerdict(nameOf(found->verdict));
}

/// Judges nothing, because neither a tolerance nor the instrument's errors are stated.
int calibration(const std::string& file, bool asJson) {
    const auto readings = readCalibrationReadings(file);
    if (!readings) return couldNotRun(readings.error());
    const auto found = fitCalibration(*readings);
    if (!found) return couldNotRun(Error{found.error().code, fmt::format("{}: {}", file, found.error().message)});
    if (asJson) {
        printJson(toJson(*found));
        return kDone;
    }
    TextTable table({">commanded", ">n", ">mean", ">residual", ">down - up"});
    for (const auto& level : found->levels) {
        const double turned = level.meanDown - level.meanUp;
        table.add({fmt::format("{:.6g}", level.commanded), fmt::to_string(level.n), fmt::format("{:.6g}", level.mean),
                   fmt::format("{:.3g}", level.residual), std::isnan(turned) ? "–" : fmt::format("{:.3g}", turned)});
    }
    table.print();
    const auto percent = [](double value) { return std::isnan(value) ? "not known" : fmt::format("{:.4g} %", value); };
    TextTable figures({"", ""});
    figures.add({"gain", fmt::format("{:.7g} ± {:.2g} (standard error{})", found->gain, found->gainStandardError,
                                     found->weighted ? ", weighted fit" : "")});
    figures.add({"offset", fmt::format("{:.5g} ± {:.2g}", found->offset, found->offsetStandardError)});
    figures.addLine(fmt::format("in % of the largest command, {:.6g}:", found->fullScale));
    figures.add({"largest residual", percent(found->residualMax_pct)});
    figures.add({"repeatability", percent(found->repeatability_pct)});
    figures.add({"hysteresis", percent(found->hysteresis_pct)});
    for (const auto& warning : found->warnings) figures.addLine(fmt::format("note: {}", warning));
    say("\n");
    figures.print();
    return kDone;
}

void printConfusion(const Identification& found) {
    std::vector<std::string> titles = {"presented"};
    for (const auto& column : found.columns) titles.push_back(">" + column);
    TextTable table(titles);
    for (std::size_t i = 0; i < found.labels.size(); ++i) {
        std::vector<std::string> row = {found.labels[i]};
        for (const std::size_t n : found.confusion[i]) row.push_back(fmt::to_string(n));
        table.add(row);
    }
    table.print();
}

using Basis = std::optional<SessionBasis>;

/// Returns the basis of the answers, as stated by the table, the option, or the file that the BIDS export puts next to
/// its table; nothing if none states a basis. Errors: InvalidArgument for an unknown word, for two that differ, and for
/// a table of several kinds, because a result is about one kind.
Result<Basis> basisOf(const std::string& file, std::string stated, std::span<const ParticipantTrials> all) {
    const std::filesystem::path sidecar = std::filesystem::path(file).replace_extension(".json");
    std::error_code error;
    if (stated.empty() && file.ends_with(".tsv") && std::filesystem::is_regular_file(sidecar, error)) {
        const auto text = readTextFile(sidecar);
        const auto about = text ? parseJson(*text, sidecar.string()) : failure(text);
        if (!about) return failure(about);
        stated = textOr(*about, "Basis");
    }
    Basis basis;
    const auto take = [&](const std::string& word) -> Result<void> {
        const auto one = valueFor(kSessionBases, word);
        if (!one) {
            return fail(ErrorCode::InvalidArgument, "the basis is \"{:.40}\"; {}, \"{}\" or \"{}\" is expected", word,
                        kSessionBases[0].text, kSessionBases[1].text, kSessionBases[2].text);
        }
        if (basis && *basis != *one) {
            return fail(ErrorCode::InvalidArgument,
                        "the answers rest on a {} and on a {}; a table of one kind is expected, since no figure is of "
                        "both",
                        nameOf(*basis), nameOf(*one));
        }
        basis = one;
        return {};
    };
    if (!stated.empty()) {
        if (auto taken = take(stated); !taken) return failure(taken);
    }
    const bool someSay = std::ranges::any_of(all, [](const auto& each) { return !each.basis.empty(); });
    for (const auto& each : all) {
        if (each.basis.empty() && someSay && stated.empty())
            return fail(ErrorCode::InvalidArgument,
                        "the basis of participant \"{:.40}\" is not stated, and that of others is; one for each is "
                        "expected",
                        each.participant);
        if (each.basis.empty()) continue;
        if (auto taken = take(each.basis); !taken) return failure(taken);
    }
    return basis;
}

/// Returns the word for the people in such results.
std::string_view whoOf(const Basis& basis) { return basis ? peopleOf(*basis) : "participants"; }

std::string basisText(const Basis& basis) {
    if (!basis) return "not known: a column \"basis\" or --basis says whether these are people";
    return std::string(peopleOf(*basis)) + (*basis == SessionBasis::Virtual ? ", a model of people" : "");
}

void printFigures(const Identification& found, const std::string& name, const Basis& basis) {
    printConfusion(found);
    const auto& all = found.all;
    say("\n  {}\n", headline(basis ? namedWith(*basis, name) : name, found, {}));
    if (all.n == 0) return;
    say("  {}\n", precisionSentence(all.n, all.chance));
    TextTable table({"", ""});
    table.add({"rests on", basisText(basis)});
    table.add({"by chance", fmt::format("p = {:.2g} (exact, one-sided)", all.pChance)});
    table.add(
        {"information", fmt::format("{} bit without what chance adds, 95 % interval", bitsText(all.itCorrected_bits))});
    for (const auto& [title, feature] : {std::pair{"texture", &found.texture}, {"pressure", &found.pressure}}) {
        if (!*feature) continue;
        const auto& figures = (*feature)->figures;
        table.add({title, fmt::format("{} of {} (chance 50 %), {} bit without what chance adds", figures.hits,
                                      figures.n, bitsText(figures.itCorrected_bits))});
    }
    if (found.catches.n > 0) {
        table.add(
            {"catch trials", fmt::format("{} of {} answered with a name", found.catches.falseAlarms, found.catches.n)});
    }
    if (found.noAnswer > 0) table.add({"no answer", fmt::format("{} trial(s)", found.noAnswer)});
    table.print();
}

/// Returns the person's results with each encoding. A session that cannot be analysed by itself is left out: the table
/// as a whole was analysed.
PersonEncodings encodingsOf(const ParticipantTrials& person) {
    std::vector<Identification> found;
    found.reserve(person.sessions.size());
    std::vector<EncodedSession> sessions;
    for (const auto& each : person.sessions) {
        auto one = identifyAsMet(each.trials);
        if (!one) continue;
        found.push_back(std::move(*one));
        EncodedSession session{each.encoding, &found.back()};
        std::set<std::size_t> training;
        for (const auto& trial : each.trials) {
            if (trial.phase == TrialPhase::Training) training.insert(trial.block);
            if (trial.phase == TrialPhase::Test && std::isfinite(trial.rt_s)) session.response_s.push_back(trial.rt_s);
        }
        session.trainingBlocks = training.size();
        sessions.push_back(std::move(session));
    }
    return {person.participant, encodingResults(sessions)};
}

/// Each person's trials name the labels that were offered as answers. Nothing is judged, and several people are not
/// pooled (pilot.md section 7). If there are several, a person whose trials cannot be analysed is named and left out.
int identification(const std::string& file, const std::string& stated, bool asJson) {
    const auto read = readIdentificationTrials(file);
    if (!read) return couldNotRun(read.error());
    const auto basis = basisOf(file, stated, *read);
    if (!basis) return couldNotRun(Error{basis.error().code, fmt::format("{}: {}", file, basis.error().message)});
    const auto basisJson = *basis ? nlohmann::json(nameOf(**basis)) : nlohmann::json();
    std::vector<PersonResult> people;
    std::vector<Identification> each;
    std::vector<PersonLeftOut> leftOut;
    std::vector<PersonEncodings> encodings;
    for (const auto& person : *read) {
        auto found = identifyAsMet(person.trials());
        if (!found) {
            leftOut.push_back({person.participant, found.error().message});
            continue;
        }
        people.push_back({.name = person.participant, .usable = true, .figures = found->all});
        each.push_back(std::move(*found));
        encodings.push_back(encodingsOf(person));
    }
    auto compared = compareEncodingsOver(std::move(encodings));
    compared.who = whoOf(*basis);
    // Adds which encoding is better, if anybody had two.
    const auto finish = [&](nlohmann::json result) {
        result["kind"] = "identification";
        result["basis"] = basisJson;
        if (!compared.pairs.empty()) result.update(toJson(compared));
        printJson(result);
    };
    const auto sayEncodings = [&] {
        for (const auto& sentence : encodingSentences(compared)) say("  {}\n", sentence);
        if (const auto set = assignmentSentence(compared); !set.empty()) say("  {}\n", set);
    };
    if (each.empty() && !leftOut.empty()) {
        const auto why = leftOut.size() == 1 ? leftOut.front().reason
                                             : fmt::format("no participant can be analysed. {}", leftOutText(leftOut));
        return couldNotRun(Error{ErrorCode::InvalidArgument, fmt::format("{}: {}", file, why)});
    }
    if (read->size() == 1) {
        const auto name = people.front().name.empty() ? file : people.front().name;
        if (asJson) {
            finish(toJson(each.front()));
        } else {
            printFigures(each.front(), name, *basis);
            sayEncodings();
        }
        return kDone;
    }
    auto together = judgeFewPeople(people, std::move(leftOut));
    together.who = whoOf(*basis);
    if (asJson) {
        auto result = toJson(together);
        for (std::size_t i = 0; i < each.size(); ++i) result["people"][i].update(toJson(each[i]));
        finish(std::move(result));
        return kDone;
    }
    for (std::size_t i = 0; i < each.size(); ++i) printFigures(each[i], people[i].name, *basis);
    say("\n  {}\n", fewPeopleSentence(together));
    sayEncodings();
    if (!*basis) say("  On whom this rests is {}.\n", basisText(*basis));
    return kDone;
}

int runAnalyze(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.size() != 2)
        return usage("analyze: a kind and a CSV file are expected, as in analyze separability trials.csv");
    const auto kind = given.front().toStdString();
    const auto file = given.at(1).toStdString();
    if (parser.isSet("basis") && kind != "identification") return usage("analyze " + kind + " takes no --basis");
    if (const auto word = parser.value("basis").trimmed().toStdString();
        parser.isSet("basis") && !valueFor(kSessionBases, word)) {
        return usage(fmt::format("analyze: --basis is \"{}\"; {}, \"{}\" or \"{}\" is expected", word,
                                 kSessionBases[0].text, kSessionBases[1].text, kSessionBases[2].text));
    }
    if (kind == "calibration") return calibration(file, parser.isSet("json"));
    if (kind == "identification") {
        return identification(file, parser.value("basis").trimmed().toStdString(), parser.isSet("json"));
    }
    if (kind == "drift")
        return trials(kind, file, parser.isSet("json"), [](const auto& read) { return judgeDrift(read); });
    if (kind == "separability")
        return trials(kind, file, parser.isSet("json"), [](const auto& read) { return judgeSeparability(read); });
    return usage(fmt::format(
        "analyze: \"{}\" cannot be analysed by this version; calibration, drift, identification and separability can",
        kind));
}

}  // namespace

const Command kAnalyze{"analyze", "{calibration|drift|identification|separability} FILE.csv [--basis BASIS] [--json]",
                       "Commanded against measured values, whether the amplitude drifts, or whether people or "
                       "measurements tell trials apart",
                       declareAnalyze, runAnalyze};

}  // namespace tacto::cli
