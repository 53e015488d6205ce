// ParticipantWindow.h - the participant's screen: what is asked, the answers as large targets with their keys, how far
// the session is, and their own STOP.
//
// It is given nothing that depends on a condition but the names of familiarisation and feedback: its pixels are the
// same for every condition in every phase, and when they change is the session's. Keys count here only, so what the
// operator types in a window of their own answers nothing. A press before the targets is reported and no answer; a key
// that is still held from before is none either. Buttons of a pad that is theirs go through the same door, whichever
// window has the keys. Without the keys, or while the operator's strip lies over it, the
// desk learns what is in the way, and no presentation starts.
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
    /// `stop` is called first thing, on a press of the target and when a held key is let go. `desk` outlives it.
    ParticipantWindow(ParticipantDesk& desk, std::function<void(const char* by)> stop, QWidget* parent = nullptr);

    void setKeys(KeySet set) { set_ = set; }
    /// A button of theirs went down or came up; `code` is the same for the same button. A question is answered by
    /// buttons only where they reach each of its targets: see setButtonAnswers().
    void moveButton(int code, const ButtonUse& use, bool down, SteadyTime at);
    void setButtonAnswers(int reached) { buttons_.reached = reached; }
    /// Written on the targets of questions that buttons answer, on what is held, and on STOP.
    void setButtonLabels(const ButtonLabels& labels);
    /// Half a sentence: a device of either person is unplugged, so no presentation starts; empty: all are there.
    void setInputGone(const QString& why);
    /// Shows a note at the upper right: "rehearsal · simulated".
    void setNote(const QString& note);
    /// Full screen there, on top, with the keys.
    void showOn(QScreen& screen);
    void takeKeys();
    /// Sets the operator's strip for a single screen; it takes the lower edge while it is open. Takes the widget.
    void setStrip(QWidget* strip);
    [[nodiscard]] bool stripOpen() const;
    void openStrip(bool open);
    /// A stop of the output by anyone: the targets go at once.
    void noteStop();
    /// How many of the participant's stops are left before the session ends; said where they press it.
    void setStopsLeft(int left);
    /// The operator's break: what the screen says between two trials meanwhile.
    void showBreak(bool on);
    [[nodiscard]] const ParticipantField& field() const;
    [[nodiscard]] QString title() const;
    /// Targets of a question are on the screen and wait for an answer.
    [[nodiscard]] bool asking() const { return asking_ && shown_; }
    /// "Answer", for the operator: what this screen shows.
    [[nodiscard]] QString says() const;

signals:
    void changed();      ///< the text has changed
    void closeWanted();  ///< the session pauses with its output off, and the window stays

protected:
    void closeEvent(QCloseEvent* event) override;
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
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
    /// Of Several.
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
    PilotPrompt prompt_;  ///< the last one
    AnswerKeys keys_;
    quint64 id_ = 0;
    bool asking_ = false;
    bool shown_ = false;  ///< the question's targets are on the screen: a press before is not an answer
    bool stopped_ = false;
    bool break_ = false;
    bool painted_ = false;
    int heldKey_ = 0;  ///< or button
    SteadyTime heldAt_{};
    AnswerButtons buttons_;
    QString inputGone_;
    EarlierPresses pressed_;
    QElapsedTimer since_;  // the targets were shown
    QTimer ticking_;

    ParticipantFace* face_;
};

}  // namespace tacto::gui
