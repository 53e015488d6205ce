// SessionPath.h - the steps of a pilot session at the left, with how each stands, and the time that is left.
#pragma once

#include <QLabel>
#include <QWidget>
#include <string>

#include "core/pilot/Prompt.h"

namespace tacto::gui {

class StepList;

inline constexpr int kUsualBlocks = 5;  // blocks in the test

/// The step that the question named `prompt` begins where the phase does not tell it: before the first trains, and
/// after the test. Empty for any other question. `massager`: there are no electrodes.
[[nodiscard]] QString stepAsked(const std::string& prompt, const std::string& phase, bool massager);

/// NoRange: this participant felt no range of levels to test, so the session ended after its thresholds.
enum class SessionEnd { Complete, NoRange, BrokenOff };

class SessionPath final : public QWidget {
    Q_OBJECT
public:
    explicit SessionPath(QWidget* parent = nullptr);
    void setTitle(const QString& title, const QString& below);
    /// `blocks` in the test, 0: thresholds alone; `counts`: the time left is for people; `massager`: there are no
    /// electrodes.
    void begin(int blocks, bool counts, bool massager);
    void show(const PilotScreen& screen);
    void asked(const PilotPrompt& prompt);
    /// The test is under way, though its screens are not shown.
    void reachTest();
    /// Nothing is under way any longer.
    void end(SessionEnd how);
    /// Nothing has begun.
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
};

}  // namespace tacto::gui
