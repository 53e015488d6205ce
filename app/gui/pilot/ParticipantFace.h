// ParticipantFace.h - what stands on the participant's screen, and where: progress, the question, the answers, STOP,
// the time to answer. It shows what it is given and knows nothing else.
//
// At 1440 x 900 it looks like the design's picture. In other sizes the targets get their 20 mm first: the second line
// is left out, then the question gets smaller; STOP keeps its place.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/pilot/AnswerTarget.h"

namespace tacto::gui {

class ParticipantField;
class ParticipantStop;
class ShareBars;

/// Answered by STOP, and by nothing else.
[[nodiscard]] bool isStopTestPrompt(const PilotPrompt& prompt);

/// "Presentation", for the operator.
[[nodiscard]] QString screenWords(ScreenState state);

struct ParticipantView {
    const PilotScreen& screen;
    std::optional<PilotPrompt> asked;  ///< the question, with its targets as they stand
    const AnswerKeys& keys;
    QString holdKey;
    QStringList buttons{};  ///< the buttons that answer it, one for each target; or none
    QString holdButton{};
    bool stopped = false;
    bool pause = false;  ///< the operator's break
};

class ParticipantFace final : public QWidget {
    Q_OBJECT
public:
    ParticipantFace(std::function<void()> stop, QWidget* parent);
    void show(const ParticipantView& view);
    /// Words alone, and no question.
    void say(const QString& title, const QString& below);
    void setNote(const QString& note);
    void setStopButtons(const QStringList& buttons);
    void setStopsLeft(int left);
    void setTimeLeft(double share);
    /// The strip lies at the lower edge while it is open. Takes the widget.
    void setStrip(QWidget* strip);
    [[nodiscard]] bool hasStrip() const { return strip_ != nullptr; }
    [[nodiscard]] bool stripOpen() const;
    void openStrip(bool open);
    [[nodiscard]] QString title() const;
    [[nodiscard]] ParticipantField& field() { return *field_; }
    /// The target that is held while levels rise: there from the question on until it is hidden.
    [[nodiscard]] AnswerTarget& hold() { return *hold_; }
    [[nodiscard]] QLineEdit& line() { return *line_; }

private:
    struct Picture;
    void put(const QString& title, const QString& below);
    [[nodiscard]] Picture picture() const;
    void arrange();
    void placeHead(const Picture& at);
    void placeTime(const Picture& at);
    [[nodiscard]] int rowsOfTargets() const;
    [[nodiscard]] int placeQuestion(const Picture& at, int fieldBottom, int wanted);
    void placeEnds(const Picture& at, int top);

    std::optional<PilotPrompt> asked_;
    QLabel* block_;
    ShareBars* blocks_;
    QLabel* note_;
    QLabel* title_;
    QLabel* below_;
    ParticipantField* field_;
    ParticipantStop* stopTarget_;
    QLabel* timeWord_;
    ShareBars* time_;
    AnswerTarget* hold_;
    QLineEdit* line_;
    QLabel* leastWord_;
    QLabel* mostWord_;
    QWidget* strip_ = nullptr;
};

/// Bars that fill: the blocks of a test side by side, the time to answer, the time of a phase.
class ShareBars final : public QWidget {
    Q_OBJECT
public:
    explicit ShareBars(QWidget* parent);
    /// One bar each, 0 to 1.
    void setShares(const std::vector<double>& shares);
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<double> shares_;
};

/// How full the bar of each block is: finished blocks are full, the present one by its trials so far. `trial` counts
/// all `trials` from 1; all blocks have the same length.
[[nodiscard]] std::vector<double> blockShares(int block, int blocks, int trial, int trials);

}  // namespace tacto::gui
