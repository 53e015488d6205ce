// StageFixture.h - a pilot stage on a simulated bench, a person who answers, and a session file for each part.
//
// Thread-safety: as PilotStage: one caller.
#pragma once

#include <algorithm>
#include <gmock/gmock.h>
#include <set>

#include "core/pilot/PilotStage.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"

namespace tacto::test {

/// A participant who answers with the first target, and stops when the test says so.
class Someone final : public PilotParticipant {
public:
    void show(const PilotScreen& screen) override {
        shown.push_back(screen);
        stopped_ = false;
        if (screen.state == ScreenState::Rest && letsGo) holds = false;
        if (onShow) onShow();
    }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        // As with real people: a stop between two questions is the answer to the next question.
        if (stopped_) return fail(ErrorCode::Stopped, "stopped before it was asked");
        if (onAsk) onAsk(prompt);
        asked.push_back(prompt.name);
        texts.push_back(prompt.text);
        if (silent.contains(prompt.name)) {
            PilotAnswer none;
            none.given = false;
            return none;
        }
        const bool goesOn = prompt.kind == PromptKind::GoOn;
        if (prompt.name == "stop-test") return stoppedBy_(testPresses > 0 ? testedBy : nameOf(prompt.to).data());
        if (!goesOn && stops > 0) {
            --stops;
            return stoppedBy_(stoppedBy);
        }
        if (goesOn && prompt.to == PromptTo::Participant && stopsAtGoOn > 0) {
            --stopsAtGoOn;
            return stoppedBy_("participant");
        }
        if (prompt.kind == PromptKind::Hold) holds = true;
        PilotAnswer answer;
        const auto told = answers.find(prompt.name);
        answer.keys.push_back(told != answers.end()    ? told->second
                              : prompt.targets.empty() ? "as asked"
                                                       : prompt.targets.front().key);
        if (const auto rated = values.find(prompt.name); rated != values.end()) answer.value = rated->second;
        answer.after = Seconds(0.5);
        return answer;
    }
    void delivered(const FeltPresentation& felt) override {
        drawn.push_back(felt.drawnFor);
        level = felt.level;
    }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return {}; }
    void cancel() noexcept override {}
    [[nodiscard]] bool holding() const noexcept override { return holds; }
    [[nodiscard]] bool letGoWasBounce() override { return std::exchange(bounces, false); }
    [[nodiscard]] std::optional<Hindrance> hindrance() const override {
        return onHindrance ? onHindrance() : std::nullopt;
    }
    [[nodiscard]] bool hasScreen() const noexcept override { return there; }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return false; }

    std::vector<std::string> asked;
    std::vector<std::string> drawn;
    double level = 0;  // what was felt last
    std::vector<PilotScreen> shown;
    std::function<void()> onShow;
    std::function<void(const PilotPrompt&)> onAsk;
    std::function<std::optional<Hindrance>()> onHindrance;
    bool there = true;
    std::set<std::string> silent;  // prompts that stay unanswered
    void press(const char* by) {
        stopped_ = true;
        stop(by);
    }

    std::vector<std::string> texts;
    std::map<std::string, std::string> answers;  // by the prompt's name; other prompts get their first target
    std::map<std::string, int> values;           // answers to scales
    int stops = 0;
    const char* stoppedBy = "participant";
    int stopsAtGoOn = 0;
    int testPresses = 0;  // how often `testedBy` presses STOP before the person whose STOP is tested
    const char* testedBy = "participant";
    bool holds = true;
    bool bounces = false;  // the next letting go is only a bounce of the button's contact
    bool letsGo = false;   // lets go as soon as allowed

private:
    bool stopped_ = false;
    [[nodiscard]] tl::unexpected<Error> stoppedBy_(const char* by) {
        if (testPresses > 0) --testPresses;
        press(by);
        return fail(ErrorCode::Stopped, "stopped by the {}", by);
    }
};

class PilotStageTest : public BenchFixture {
protected:
    ~PilotStageTest() override { close(); }
    void SetUp() override {
        profile_.electrodeArea = SquareCentimetres(4);
        person_ = PersonSetup{.participant = "P-7K3M",
                              .consentRecorded = true,
                              .discomfortLimit = Milliamps(30),
                              .rampStep = Milliamps(1)};
        clockOfFile_ = std::make_shared<VirtualClock>();
        begin();
    }
    /// Begins a part of the session, which gets the rows of the earlier parts.
    void begin(const std::vector<SessionRow>& earlier = {}) {
        close();
        ++part_;
        writer_ = SessionWriter::create(file(), {}, *clockOfFile_).value();
        session_ = writer_.get();
        open({"sim:stimulator?mode=current&step=0.5mA" + more_}, {Role::Stimulator});
        ASSERT_TRUE(bench_);
        record_ = std::make_unique<PilotRecord>(*writer_, *clock_, earlier);
        PilotSettings settings;
        settings.code = "P-7K3M";
        settings.basis = SessionBasis::Virtual;
        stage_ = std::make_unique<PilotStage>(*bench_, someone_, *record_, settings);
    }
    /// Must come before the session's end, since the bench writes to the session.
    void close() {
        stage_.reset();
        record_.reset();
        bench_.reset();
    }
    [[nodiscard]] std::filesystem::path file() const { return dir_.path() / fmt::format("{}.tacto", part_); }
    [[nodiscard]] std::vector<SessionRow> rows() const { return SessionReader::open(file()).value().events().value(); }
    /// Returns all rows up to the first of this kind, as if the program had died there.
    [[nodiscard]] std::vector<SessionRow> rowsUntil(const char* kind) const {
        auto all = rows();
        all.erase(std::next(std::ranges::find(all, kind, &SessionRow::name)), all.end());
        return all;
    }
    [[nodiscard]] std::vector<nlohmann::json> bodies(const char* kind) const {
        std::vector<nlohmann::json> all;
        for (const auto& each : rows())
            if (each.name == kind) all.push_back(each.body);
        return all;
    }
    [[nodiscard]] std::vector<std::string> answered() const {
        std::vector<std::string> all;
        for (const auto& body : bodies(row::kAnswer)) all.push_back(body["name"]);
        return all;
    }
    /// Returns the session's rows of certain kinds, in order.
    [[nodiscard]] std::vector<std::string> kinds() const {
        std::vector<std::string> all;
        for (const auto& each : rows()) {
            for (const char* kind : {row::kTrialBegin, row::kAnswer, row::kParticipantStop, row::kContinue,
                                     row::kOperatorStop, row::kSessionEnd})
                if (each.name == kind) all.push_back(each.name);
        }
        return all;
    }
    /// The operator takes six seconds for the electrodes. A faulted bench lets no time pass, so the clock is moved.
    void operatorTakesTime() {
        someone_.onAsk = [this](const PilotPrompt& prompt) {
            const Seconds time(6);
            if (prompt.to != PromptTo::Operator || bench_->wait(time)) return;
            std::static_pointer_cast<VirtualClock>(clock_)->advanceTo(clock_->now() + toInstant(time));
        };
    }
    [[nodiscard]] StageTrial trial(const std::string& name = "test 1", double level = 0.5) const {
        StageTrial made;
        made.name = name;
        made.about = {{"number", 1}, {"phase", "test"}, {"block", 1}, {"condition", "rough-high"}};
        made.level = level;
        made.presentation = ascendingPresentation(Milliamps(level), Seconds(0.5));
        made.prompt = strengthPrompt();
        made.screen.state = ScreenState::Feel;
        return made;
    }
    [[nodiscard]] StageTrial rising(double level) const {
        auto made = trial(fmt::format("ascending {}", level), level);
        made.held = made.stopAnswers = true;
        return made;
    }
    void acceptOne() {
        for (const double level : {0.5, 1.0}) {
            const auto made = rising(level);
            ASSERT_TRUE(stage_->trial(made));
            ASSERT_TRUE(stage_->judged(level, false, made.name, false));
        }
    }

    ScratchDir dir_;
    std::shared_ptr<VirtualClock> clockOfFile_;
    int part_ = 0;
    std::string more_;  // more keys for the stimulator's address
    Someone someone_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<PilotRecord> record_;
    std::unique_ptr<PilotStage> stage_;
};

}  // namespace tacto::test
