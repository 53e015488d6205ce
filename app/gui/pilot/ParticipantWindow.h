// ParticipantWindow.h - the participant's screen: the question, the answers as large targets with their keys, the
// progress of the session, and the participant's own STOP.
//
// The window is told nothing about a condition except its name in familiarisation and feedback: the pixels are the same
// for every condition in every phase, and the session decides when they change. Only keys typed in this window answer;
// keys typed in the operator's window do not. A press before the targets appear is reported, but is no answer; nor is a
// key held from before. Buttons of the participant's pad follow the same rules, whichever window has the focus. While
// this window lacks the focus or the operator's strip covers it, the desk is told so, and no presentation starts.
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <functional>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/pilot/ButtonUse.h"
#include "app/gui/pilot/ParticipantDesk.h"

namespace tacto::gui {

class ParticipantFace;
class ParticipantField;

class ParticipantWindow final : public QWidget {
    Q_OBJECT
public:
    /// Calls `stop` before all else when the target is pressed or a held key is released. `desk` must outlive this.
    ParticipantWindow(ParticipantDesk& desk, std::function<void(const char* by)> stop, QWidget* parent = nullptr);

    void setWords(const ParticipantWords& words);
    void setKeys(KeySet set) { set_ = set; }
    /// Handles a press or release of one of the participant's buttons; each button has its own `code`. Buttons answer a
    /// question only if they reach every target: see setButtonAnswers().
    void moveButton(int code, const ButtonUse& use, bool down, SteadyTime at);
    void setButtonAnswers(int reached) { buttons_.reached = reached; }
    /// Sets the labels for targets that buttons answer, for the held target and for STOP.
    void setButtonLabels(const ButtonLabels& labels);
    /// Sets half a sentence that says which device is unplugged, so that no presentation starts; empty if none is.
    void setInputGone(const QString& why);
    /// Shows a note at the upper right: "rehearsal · simulated".
    void setNote(const QString& note);
    /// Shows the window full screen on `screen`, on top and with the keyboard focus.
    void showOn(QScreen& screen);
    void takeKeys();
    /// Sets the operator's strip for a single screen; while open it covers the lower edge. Takes ownership.
    void setStrip(QWidget* strip);
    [[nodiscard]] bool stripOpen() const;
    void openStrip(bool open);
    /// Removes the targets at once after anyone has stopped the output.
    void noteStop();
    /// Shows next to STOP how many of the participant's stops are left before the session ends.
    void setStopsLeft(int left);
    /// Shows or hides the notice of the operator's break between two trials.
    void showBreak(bool on);
    [[nodiscard]] const ParticipantField& field() const;
    [[nodiscard]] QString title() const;
    /// True if the targets of a question are on the screen and wait for an answer.
    [[nodiscard]] bool asking() const { return asking_ && shown_; }
    /// Returns what this screen shows, for the operator, such as "Answer".
    [[nodiscard]] QString says() const;

signals:
    void changed();      ///< the text has changed
    void closeWanted();  ///< asks to close: the session pauses with its output off, and the window stays

protected:
    void closeEvent(QCloseEvent* event) override;
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void showScreen(const PilotScreen& screen);
    void ask(const PilotPrompt& prompt, quint64 id);
    void closeQuestion(quint64 id);
    void noteShown();
    void showState();
    [[nodiscard]] int holdKey() const;
    void choose(int target, SteadyTime at);
    [[nodiscard]] bool takesPress(int code, SteadyTime at, bool repeated, std::optional<int> would);
    /// Returns the keys of the targets chosen in a Several question.
    [[nodiscard]] std::vector<std::string> chosenKeys() const;
    void give(PilotAnswer answer, SteadyTime at);
    void pressHold();
    void letGo();
    void noteEarly(std::optional<int> target);
    [[nodiscard]] bool feels() const;
    [[nodiscard]] bool isStopTest() const;
    void judge();
    void tick();

    ParticipantDesk& desk_;
    const std::function<void(const char*)> stop_;
    KeySet set_ = KeySet::Figures;
    PilotScreen screen_;
    ParticipantWords words_ = ParticipantWords::english();
    PilotPrompt prompt_;  ///< the last prompt
    AnswerKeys keys_;
    quint64 id_ = 0;
    bool asking_ = false;
    bool operatorsTest_ = false;  ///< the operator's STOP is being tested
    bool shown_ = false;          ///< true if the question's targets are on the screen; an earlier press is no answer
    bool stopped_ = false;
    bool break_ = false;
    bool painted_ = false;
    int heldKey_ = 0;  ///< the key or button that is held; 0 if none
    SteadyTime heldAt_{};
    AnswerButtons buttons_;
    QString inputGone_;
    EarlierPresses pressed_;
    QElapsedTimer since_;  // runs from the moment the targets were shown
    QTimer ticking_;

    ParticipantFace* face_;
};

}  // namespace tacto::gui
