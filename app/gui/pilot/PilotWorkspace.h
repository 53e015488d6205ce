// PilotWorkspace.h - the workspace for pilot sessions: choosing a rehearsal or a study, running a session with its two
// windows, and viewing its result.
#pragma once

#include <QFrame>
#include <QWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/SessionConduct.h"
#include "app/gui/runner/ReportMaker.h"
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
    /// Sets the devices that both start pages offer; null if there are none.
    void setButtonDevices(const std::shared_ptr<const ButtonDevices>& devices);
    void refresh(const Telemetry& telemetry) { session_->refresh(telemetry); }
    [[nodiscard]] bool running() const { return session_->running(); }
    /// Lets the study keep a yes of the checklist before the program ends. Returns false once, and says why, if it
    /// cannot.
    [[nodiscard]] bool mayClose();
    /// True if conditions, levels and trains are now hidden from the operator in the whole window.
    [[nodiscard]] bool blind() const { return running() && session_->start().blind; }
    /// Returns the safety bar's words for a blind session: "Participant’s STOP: not pressed", and further facts if any.
    [[nodiscard]] QString stopWords() const;
    /// Handles Pause and Resume of the safety bar: begins a break at once, or ends the break.
    void pauseSession(bool pause) { pause ? session_->breakNow() : session_->wantBreak(false); }
    [[nodiscard]] bool sessionPaused() const { return session_->breakWanted(); }
    /// Hides or shows the path of the session.
    void showPlotOnly(bool only);
    /// Stops by the participant's keys; returns false if no session with a person is running.
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
    void makeReport();
    void showPage(Page page);
    void showBeside(Page page);
    void prepareStart(const QString& code);
    /// Lets the study keep a yes of the checklist for the day. Returns why it cannot; empty if it did or there is none.
    [[nodiscard]] QString keepExclusions();
    /// Leaves the start page once a yes of its checklist is kept; otherwise stays and says why.
    bool leaveStart();
    void showRecorded(const RunResult& result, bool ofStudy);
    /// Offers to go on with the session that has just ended, if it was interrupted and can go on.
    void offerToGoOn();
    void goOn();
    void beginRehearsal(bool goOn);
    void beginOfStudy();
    void sayWhereItBegan(const QString& why);

    OpenStudy study_{this};
    OpenStudy rehearsed_;  ///< a rehearsal whose result is read, or that is exported
    QString wanted_;       ///< the session of that result
    QString exportTo_;     ///< where it is exported instead; empty: it is not
    QString shown_;        ///< the folder of the result shown
    QString recorded_;     ///< the record of the result shown, in which a signature is noted
    ReportMaker reports_;  ///< of rehearsals; a study's page draws its own
    bool plotOnly_ = false;
    bool lossSaid_ = false;  ///< it was said that a yes of the checklist could not be kept
    bool ofStudy_ = false;   ///< true if the running session, or the session of the result shown, belongs to a study
    bool reopened_ = false;  ///< true if the result shown was read from its record
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
