// ParticipantFace.h - contents and layout of the participant's screen: progress, the question, the answers, STOP and
// the time to answer. The face shows only what it is given.
//
// At 1440 x 900 the screen looks like the design's picture. At other sizes targets keep at least 20 mm if possible: the
// second line is left out first, then the question gets smaller. STOP keeps its place.
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

/// True if only STOP answers the prompt.
[[nodiscard]] bool isStopTestPrompt(const PilotPrompt& prompt);

/// Returns the state's name for the operator, such as "Presentation".
[[nodiscard]] QString screenWords(ScreenState state);

struct ParticipantView {
    const PilotScreen& screen;
    std::optional<PilotPrompt> asked;  ///< the question, with its targets in the order shown
    const AnswerKeys& keys;
    QString holdKey;
    QStringList buttons{};  ///< the buttons that answer the question, one for each target; empty if none do
    QString holdButton{};
    bool stopped = false;
    bool pause = false;  ///< true during the operator's break
};

class ParticipantFace final : public QWidget {
    Q_OBJECT
public:
    ParticipantFace(std::function<void()> stop, QWidget* parent);
    void show(const ParticipantView& view);
    /// Shows words alone, without a question.
    void say(const QString& title, const QString& below);
    void setWords(const ParticipantWords& words);
    void setNote(const QString& note);
    void setStopButtons(const QStringList& buttons);
    void setStopsLeft(int left);
    void setTimeLeft(double share);
    /// Sets the strip, which covers the lower edge while open. Takes ownership of the widget.
    void setStrip(QWidget* strip);
    [[nodiscard]] bool hasStrip() const { return strip_ != nullptr; }
    [[nodiscard]] bool stripOpen() const;
    void openStrip(bool open);
    [[nodiscard]] QString title() const;
    [[nodiscard]] ParticipantField& field() { return *field_; }
    /// Returns the target that is held while levels rise; visible from the question until it is hidden.
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

    [[nodiscard]] QString word(std::string_view key, ParticipantWords::Places places = {}) const;
    [[nodiscard]] QString phaseTitle(const std::string& phase) const;
    [[nodiscard]] QString howToAnswer(const ParticipantView& view) const;

    ParticipantWords words_ = ParticipantWords::english();
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

/// Progress bars for the blocks of a test (side by side), the time to answer, or the time of a phase.
class ShareBars final : public QWidget {
    Q_OBJECT
public:
    explicit ShareBars(QWidget* parent);
    /// Sets one bar for each share, 0 to 1.
    void setShares(const std::vector<double>& shares);
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<double> shares_;
};

/// Returns how full each block's bar is: finished blocks are full, the present one is filled by its trials so far.
/// `trial` runs from 1 to `trials` over all blocks; all blocks have the same length.
[[nodiscard]] std::vector<double> blockShares(int block, int blocks, int trial, int trials);

}  // namespace tacto::gui
