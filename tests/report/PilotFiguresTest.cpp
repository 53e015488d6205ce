// The figures of a pilot study: what they show, counted out from the trials, and that each is drawn from one
// description.
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "app/report/FigureDrawing.h"
#include "app/report/PilotFigures.h"
#include "app/report/StudyReport.h"
#include "core/base/Csv.h"
#include "core/base/Random.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kShownLabels = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

SessionRecord randomSession(Random& random, int number) {
    SessionRecord session;
    session.about.number = number;
    auto& results = session.results;
    results.number = static_cast<std::size_t>(number);
    results.days = 3 * (number - 1) + static_cast<double>(random.below(2));
    results.encoding = random.below(2) == 0 ? "standard" : "swapped";
    results.labels = kShownLabels;
    results.felt = 2 + 2 * random.uniform();
    results.detection = results.felt;
    results.detectionLow = 0.9 * results.felt;
    results.detectionHigh = 1.2 * results.felt;
    results.measurements = 1 + random.below(2);
    for (std::size_t i = 0, n = random.below(40); i < n; ++i) {
        BidsThresholdTrial trial;
        trial.measurement = i < n / 3 ? 1 : results.measurements;
        trial.procedure = "detection";
        trial.number = i + 1;
        trial.current = Milliamps(1 + 0.5 * double(random.below(8)));
        trial.correct = random.uniform() < 0.8;
        results.thresholds.push_back(trial);
    }
    const std::size_t blocks = random.below(6);
    for (std::size_t i = 0; i < 16 * blocks; ++i) {
        BidsTrial row;
        row.trial.number = i + 1;
        row.trial.block = i / 16 + 1;
        row.trial.condition = kShownLabels[i % 4];
        row.trial.response = kShownLabels[random.uniform() < 0.7 ? i % 4 : random.below(4)];
        row.trial.rt_s = 0.3 + random.uniform();
        results.trials.push_back(row);
    }
    for (std::size_t block = 2; block <= blocks; ++block)
        results.drift.push_back({block, 3 + random.uniform(), false, 2.5, 4.5});
    return session;
}

StudyRecord randomStudy(Random& random, std::size_t people) {
    StudyRecord study;
    study.settings.encodings = {"standard", "swapped"};
    for (std::size_t i = 0; i < people; ++i) {
        ParticipantRecord one;
        one.about.code = fmt::format("P-{:04}", i);
        for (int number = 1, n = int(random.below(4)); number <= n; ++number)
            one.sessions.push_back(randomSession(random, number));
        study.participants.push_back(std::move(one));
    }
    return study;
}

const CurvesFigure& curvesOf(const PilotFigure& figure) { return std::get<CurvesFigure>(figure.figure.content); }

const PilotFigure* named(const std::vector<PilotFigure>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &PilotFigure::name);
    return found == all.end() ? nullptr : &*found;
}

TEST(PilotFigures, ShowTheSharesThatAreCountedFromTheTrials) {
    RecordProperty("hazard", "H9");
    Random random(16, "figures of a study");
    const int rounds = test::trials<int>({.local = 20, .ci = 100, .campaign = 1000});
    for (int round = 0; round < rounds; ++round) {
        const auto study = randomStudy(random, 1 + random.below(5));
        const auto all = test::accepted(pilotFigures(study));
        std::set<std::string> names;
        for (const auto& each : all) EXPECT_TRUE(names.insert(each.name).second) << each.name;
        for (const auto& one : study.participants) {
            for (const auto& session : one.sessions) {
                const auto name = fmt::format("{}-session-{}", one.about.code, session.about.number);
                std::map<double, std::pair<double, double>> levels;  // right, all
                std::size_t last = 0;                                // of the last measurement, as the row's estimate
                for (const auto& trial : session.results.thresholds) {
                    if (trial.measurement < session.results.measurements) continue;
                    ++last;
                    levels[trial.current.value()].second += 1;
                    levels[trial.current.value()].first += *trial.correct ? 1 : 0;
                }
                const auto* function = named(all, name + "-function");
                ASSERT_EQ(function == nullptr, levels.empty()) << name;
                if (function == nullptr) continue;
                const auto& trials = curvesOf(*function).curves.at(1);
                ASSERT_EQ(trials.x.size(), levels.size());
                std::size_t i = 0;
                for (const auto& [level, counts] : levels) {
                    const auto [right, n] = counts;
                    EXPECT_EQ(trials.x[i], level);
                    EXPECT_EQ(trials.n[i], n);
                    EXPECT_NEAR(trials.y[i], 100 * right / n, 1e-9);
                    // Wilson's ends solve (p − right/n)² = z² p (1 − p)/n.
                    for (const double end : {trials.low[i] / 100, trials.high[i] / 100})
                        EXPECT_NEAR(std::pow(end - right / n, 2), 3.84146 * end * (1 - end) / n, 1e-5);
                    ++i;
                }
                const auto* trace = named(all, name + "-trace");
                ASSERT_NE(trace, nullptr);
                const auto& shown = curvesOf(*trace).curves;
                EXPECT_EQ(shown.at(0).x.size(), last);
                EXPECT_EQ(shown.at(1).x.size() + shown.at(2).x.size(), last);
            }
            const auto* learning = named(all, one.about.code + "-blocks");
            std::size_t tested = 0;
            for (const auto& session : one.sessions) {
                if (session.results.trials.empty()) continue;
                ASSERT_NE(learning, nullptr);
                const auto& curve = curvesOf(*learning).curves.at(tested++);
                std::map<std::size_t, double> right;
                for (const auto& row : session.results.trials)
                    right[row.trial.block] += row.trial.condition == row.trial.response ? 1 : 0;
                ASSERT_EQ(curve.x.size(), right.size());
                for (std::size_t i = 0; i < curve.x.size(); ++i)
                    EXPECT_NEAR(curve.y[i], 100 * right[std::size_t(curve.x[i])] / 16, 1e-9);
            }
            EXPECT_EQ(learning == nullptr, tested == 0);
            const auto* times = named(all, one.about.code + "-response-times");
            ASSERT_EQ(times == nullptr, tested == 0);
            for (const auto& curve : times == nullptr ? std::vector<CurvesFigure::Curve>() : curvesOf(*times).curves) {
                for (std::size_t i = 0; i < curve.x.size(); ++i) {
                    double by = 0, n = 0;
                    for (const auto& session : one.sessions) {
                        for (const auto& row : session.results.trials) {
                            if (QString::fromStdString(row.trial.condition) != curve.label) continue;
                            n += 1;
                            by += row.trial.rt_s <= curve.x[i] ? 1 : 0;
                        }
                    }
                    EXPECT_NEAR(curve.y[i], 100 * by / n, 1e-9);
                }
            }
        }
        // Over people: each person's first session, and the mean of those who have it.
        const auto* sessions = named(all, "people-sessions");
        if (sessions == nullptr) continue;
        double sum = 0, n = 0;
        for (const auto& one : study.participants) {
            if (one.sessions.empty() || one.sessions.front().results.trials.empty()) continue;
            double right = 0, trials = 0;
            for (const auto& row : one.sessions.front().results.trials) {
                trials += 1;
                right += row.trial.condition == row.trial.response ? 1 : 0;
            }
            sum += 100 * right / trials;
            n += 1;
        }
        const auto& mean = curvesOf(*sessions).curves.back();
        if (n > 1 && mean.points && mean.x.front() < 1.5) EXPECT_NEAR(mean.y.front(), sum / n, 1e-9);
    }
}

TEST(PilotFigures, AreTheSameInTheReportAndAsFiles) {
    RecordProperty("hazard", "H9");
    Random random(3, "figures in files");
    const auto study = randomStudy(random, 3);
    const auto all = test::accepted(pilotFigures(study));
    ASSERT_GT(all.size(), 5U);
    const test::ScratchDir folder;
    const auto out = folder.path() / "figures";
    test::accepted(writeFigures(all, out));
    const auto report = test::accepted(studyReport(study));
    std::set<std::string> inReport;
    for (const auto& block : report.blocks) {
        if (const auto* figure = std::get_if<FigureBlock>(&block))
            inReport.insert(sheetSvg(*figure->sheet, "title").toStdString());
    }
    for (const auto& each : all) {
        const auto text = test::accepted(readTextFile(out / (each.name + ".svg")));
        EXPECT_THAT(text, HasSubstr("<svg"));
        EXPECT_EQ(text.find("nan"), std::string::npos) << each.name;
        const auto sheet = drawFigure(each.figure, each.simulated);
        EXPECT_TRUE(inReport.contains(sheetSvg(*sheet, "title").toStdString())) << each.name;
    }
    EXPECT_FALSE(writeFigures(all, out)) << "the folder is not empty any more";
}

}  // namespace
}  // namespace tacto
