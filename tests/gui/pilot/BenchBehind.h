// BenchBehind.h - the bench behind a participant's window in a test: a simulated bench that records a session, with
// time that passes at once, and a participant whose sensations the test knows.
//
// Thread-safety: BenchBehind like its parts; Feeling like PilotParticipant, felt() from any thread.
#pragma once

#include <mutex>
#include <nlohmann/json.hpp>

#include "app/gui/pilot/ParticipantDesk.h"
#include "core/pilot/PilotStage.h"
#include "core/session/SessionWriter.h"
#include "tests/bench/PersonFixture.h"

namespace tacto::test {

/// Contains no test itself.
class BenchBehind final : public PersonFixture {
public:
    BenchBehind() {
        writer_ = SessionWriter::create(dir_.path() / "session.tacto", {}, fileClock_).value();
        session_ = writer_.get();
        openPerson();
        record_ = std::make_unique<PilotRecord>(*writer_, *clock_, std::vector<SessionRow>());
    }
    ~BenchBehind() override {
        record_.reset();
        bench_.reset();
    }
    void TestBody() override {}
    [[nodiscard]] Bench& bench() { return *bench_; }
    [[nodiscard]] PilotRecord& record() { return *record_; }
    [[nodiscard]] SessionWriter& writer() { return *writer_; }
    [[nodiscard]] static PilotSettings settings() {
        PilotSettings settings;
        settings.code = "P-7K3M";
        settings.blocks = 1;
        return settings;
    }

private:
    ScratchDir dir_;
    VirtualClock fileClock_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<PilotRecord> record_;
};

/// Passes everything on to the window, and records what the participant feels.
class Feeling final : public PilotParticipant {
public:
    explicit Feeling(gui::ParticipantDesk& desk) : desk_(desk) {
        desk_.stop = [this](const char* by) {
            if (stop) stop(by);
        };
    }
    void show(const PilotScreen& screen) override { desk_.show(screen); }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override { return desk_.ask(prompt); }
    void delivered(const FeltPresentation& felt) override {
        const std::scoped_lock lock(mutex_);
        all_.push_back(felt);
    }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return desk_.takeEarly(); }
    void cancel() noexcept override { desk_.cancel(); }
    [[nodiscard]] bool holding() const noexcept override { return desk_.holding(); }
    [[nodiscard]] std::optional<Hindrance> hindrance() const override { return desk_.hindrance(); }
    [[nodiscard]] bool hasScreen() const noexcept override { return desk_.hasScreen(); }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return true; }
    /// The last presentation; an empty one before the first.
    [[nodiscard]] FeltPresentation felt() const {
        const std::scoped_lock lock(mutex_);
        return all_.empty() ? FeltPresentation() : all_.back();
    }
    /// All presentations in order.
    [[nodiscard]] std::vector<FeltPresentation> all() const {
        const std::scoped_lock lock(mutex_);
        return all_;
    }

private:
    gui::ParticipantDesk& desk_;
    mutable std::mutex mutex_;
    std::vector<FeltPresentation> all_;  // guarded by mutex_
};

}  // namespace tacto::test
