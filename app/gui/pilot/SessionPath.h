// SessionPath.h - the steps of a pilot session, at the left of the page, with the state of each and the time left.
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QWidget>
#include <string>

#include "core/pilot/Prompt.h"

namespace tacto::gui {

class StepList;

inline constexpr int kUsualBlocks = 5;  // usual number of blocks in the test

/// Returns how long a session with a person takes, "about 66 min". `blocks`: number in the test, 0 for thresholds
/// alone.
[[nodiscard]] QString sessionLasts(int blocks);

/// Returns the step that begins with the question `prompt`, if the phase does not tell: before the first trains and
/// after the test. Empty for any other question. `massager`: there are no electrodes.
[[nodiscard]] QString stepAsked(const std::string& prompt, const std::string& phase, bool massager);

/// NoRange: the participant felt no range of levels to test, so the session ended after its thresholds.
enum class SessionEnd { Complete, NoRange, BrokenOff };

class SessionPath final : public QWidget {
    Q_OBJECT
public:
    explicit SessionPath(QWidget* parent = nullptr);
    void setTitle(const QString& title, const QString& below);
    /// `blocks`: number in the test, 0 for thresholds alone; `counts`: show the time left, which holds for people only;
    /// `massager`: there are no electrodes.
    void begin(int blocks, bool counts, bool massager);
    void show(const PilotScreen& screen);
    void asked(const PilotPrompt& prompt);
    /// Takes the number of blocks as the session has it.
    void count(const PilotCounts& counts);
    /// Marks the session as ended; no step is under way any more.
    void end(SessionEnd how);
    /// Resets to the state before a session.
    void clear();
    using QWidget::show;

private:
    void nameSeats(bool massager);
    void reach(int step);
    void reachFor(const std::string& name);
    [[nodiscard]] bool has(int step) const;
    [[nodiscard]] QString timeLeft() const;
    QLabel* title_;
    QLabel* below_;
    StepList* steps_;
    QLabel* leftWord_;
    QLabel* left_;
    PilotScreen screen_;
    int step_ = 0;
    int blocks_ = kUsualBlocks;
    bool counts_ = false;
    QElapsedTimer since_;    // since the step began
    QElapsedTimer trialAt_;  // since the last trial of the test began
    double trials_s_ = 0;    // how long trials of the test took ...
    int trials_ = 0;         // ... and how many
};

}  // namespace tacto::gui
