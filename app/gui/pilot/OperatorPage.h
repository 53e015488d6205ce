// OperatorPage.h - the operator's side of a session: phase and time left, impedance, notes, break and abort, and the
// operator's questions. The page is not told the condition, level, interval or answer, so it cannot show them. Other
// session messages appear only if the operator is not blind or may know them.
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "app/gui/pilot/OperatorAsk.h"
#include "app/gui/pilot/PhaseBar.h"
#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/SessionNotes.h"
#include "core/bench/Telemetry.h"
#include "core/pilot/Prompt.h"

namespace tacto::gui {

class ImpedanceTrend;

class OperatorPage final : public QWidget {
    Q_OBJECT
public:
    explicit OperatorPage(QWidget* parent = nullptr);
    void begin(const PilotStart& start);
    void show(const PilotScreen& screen);
    /// Shows a question to the participant or the operator.
    void ask(const PilotPrompt& prompt, quint64 id);
    void closeQuestion(quint64 id);
    void refresh(const Telemetry& telemetry);
    /// Sets the reason why the next presentation cannot start; empty if there is none.
    void setObstacle(const QString& why);
    void setBreakDue(bool due);
    /// Shows what is on disk.
    void count(const PilotCounts& counts);
    /// Returns the heading: the present part of the session.
    [[nodiscard]] QString where() const { return where_->text(); }
    /// Returns where the session is and how long it still waits: what the participant may read as well.
    [[nodiscard]] QString whereAndWaits() const;
    [[nodiscard]] OperatorAsk& question() { return *ask_; }
    [[nodiscard]] SessionNotes& notes() { return *notes_; }

signals:
    void breakAfterTrialWanted(bool due);
    void breakNowWanted();
    void abortWanted();
    void keysWanted();  ///< asks for the keyboard focus to go to the participant's window

private:
    [[nodiscard]] QWidget* buildBar();
    void showWhere();
    void showCounts();
    /// Returns how long the screen still waits, in seconds; nothing if it waits for a person.
    [[nodiscard]] std::optional<double> waits_s() const;
    void showTold();
    void showTrend();
    void keepRoomForObstacle();

    QLabel* where_;
    QLabel* counts_;
    QLabel* hidden_;
    PhaseBar* phase_;
    ImpedanceTrend* trend_;
    SessionNotes* notes_;
    OperatorAsk* ask_;
    QWidget* obstacle_;
    QLabel* obstacleText_ = nullptr;
    QPushButton* after_ = nullptr;
    QPushButton* now_ = nullptr;
    QPushButton* abort_ = nullptr;
    QLabel* onDisk_ = nullptr;
    QWidget* sure_ = nullptr;
    QPushButton* reallyAbort_ = nullptr;
    PilotScreen screen_;
    QString asked_;  ///< the step that began with the last question
    bool blind_ = true;
    bool breakDue_ = false;
    bool vibrates_ = false;  ///< true if a massager delivers
    bool virtual_ = false;   ///< true for a virtual participant
    PilotCounts kept_;
    Instant at_{0};                      ///< the time of the newest telemetry
    std::optional<PilotPrompt> theirs_;  ///< the question at the participant's screen
    quint64 theirsId_ = 0;
    QElapsedTimer phaseSince_;
};

}  // namespace tacto::gui
