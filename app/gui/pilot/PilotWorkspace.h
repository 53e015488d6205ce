// PilotWorkspace.h - the workspace of those who run pilot sessions: a rehearsal or a study, a session with its two
// windows, its result.
#pragma once

#include <QFrame>
#include <QWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/SessionConduct.h"
#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

class OperatorPage;
class PageStack;
class PilotResult;
class RehearsalPage;
class SessionPath;
class SessionSide;
class SessionStartPage;
class StudyPage;
class TabbedPage;

class PilotWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit PilotWorkspace(BenchController& controller, QWidget* parent = nullptr);
    ~PilotWorkspace() override;
    /// Sets the devices that both pages offer; null: there are none.
    void setButtonDevices(const std::shared_ptr<const ButtonDevices>& devices);
    void refresh(const Telemetry& telemetry) { session_->refresh(telemetry); }
    [[nodiscard]] bool running() const { return session_->running(); }
    /// Whether conditions, levels and trains are hidden from the operator now, in the whole window.
    [[nodiscard]] bool blind() const { return running() && session_->start().blind; }
    /// The safety bar's words in a blind session: "Participant’s STOP: not pressed", and what else there is to say.
    [[nodiscard]] QString stopWords() const;
    /// Pause and Resume of the safety bar: a break at once, and its end.
    void pauseSession(bool pause) { pause ? session_->breakNow() : session_->wantBreak(false); }
    [[nodiscard]] bool sessionPaused() const { return session_->breakWanted(); }
    /// Hides the path of the session.
    void showPlotOnly(bool only);
    /// A stop by the participant's keys; false where no session of a person runs.
    bool stopAsParticipant(const char* by) { return session_->stopAsParticipant(by); }
    /// Null while no session runs.
    [[nodiscard]] ParticipantWindow* participantWindow() const { return session_->window(); }

signals:
    void attentionWanted();
    void runningChanged();

private:
    enum Page { kHome, kStart, kSession, kOutcome };
    [[nodiscard]] QWidget* buildHome();
    void connectSession();
    void connectResult();
    void showPage(Page page);
    void showBeside(Page page);
    void prepareStart(const QString& code);
    void showRecorded(const RunResult& result);
    void beginRehearsal(bool goOn);
    void beginOfStudy();
    void sayWhereItBegan(const QString& why);

    OpenStudy study_;
    bool plotOnly_ = false;
    bool ofStudy_ = false;   ///< the running session, or the one whose result is shown
    bool reopened_ = false;  ///< the result that is shown was read from its record
    SessionPath* path_;
    PageStack* pages_;
    TabbedPage* home_ = nullptr;
    RehearsalPage* rehearsal_ = nullptr;
    StudyPage* studies_ = nullptr;
    SessionStartPage* start_;
    OperatorPage* page_;
    PilotResult* result_;
    SessionSide* side_;
    QFrame* pathEdge_ = nullptr;
    QFrame* sideEdge_ = nullptr;
    std::unique_ptr<SessionConduct> session_;
};

}  // namespace tacto::gui
