// ParticipantField.h - the middle of the participant's screen: a dot, a name, the two intervals of a detection trial,
// or the targets of a question, always in the same place.
//
// Targets of a question are at least kTarget_mm wide and high, if the screen has room.
#pragma once

#include <QWidget>
#include <vector>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/pilot/AnswerTarget.h"

class QPainter;

namespace tacto::gui {

constexpr double kTarget_mm = 20;

/// Converts a length to logical pixels on this screen; assumes 96 per inch if the screen does not give its size.
[[nodiscard]] int pixelsOf(double mm, const QWidget& on);

/// Returns the icons next to a condition's words; none for an unknown condition.
[[nodiscard]] QStringList iconsOf(const std::string& key);
/// Returns the number of columns for this number of targets, if they are not a scale.
[[nodiscard]] int fieldColumns(int count);

class ParticipantField final : public QWidget {
    Q_OBJECT
public:
    explicit ParticipantField(QWidget* parent);
    void clear();
    void showDot();
    void showWord(const QString& word, const QStringList& icons);
    /// Shows the two intervals of a detection trial at the places of the targets "first" and "second". `passing` says
    /// which one is filled: 1, 2, or 0 for neither.
    void showIntervals(int passing);
    /// `buttons`: pad buttons written on the targets; the list may be shorter than the targets, or empty.
    void showTargets(const PilotPrompt& prompt, const AnswerKeys& keys, const QStringList& buttons = {});
    /// Sets the sizes in pixels of words and keys, and the gap between targets.
    void setType(int words_px, int key_px, int gap_px);
    /// Marks whether a target of a Several prompt is chosen.
    void setChosen(int target, bool chosen);
    [[nodiscard]] bool chosen(int target) const;
    /// Returns the targets of the prompt shown, in the order of its keys; for Several the last is "done".
    [[nodiscard]] const std::vector<AnswerTarget*>& targets() const { return targets_; }

signals:
    void chosenAt(int target, tacto::gui::SteadyTime at);
    void missed();  ///< a press outside every target

protected:
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    enum class Content { Nothing, Dot, Word, Intervals, Targets };
    void arrange();
    void alignWords();
    void drop();
    void paintIntervals(QPainter& painter) const;

    Content content_ = Content::Nothing;
    PromptKind kind_ = PromptKind::GoOn;
    std::vector<AnswerTarget*> targets_;
    QString word_;
    QStringList wordIcons_;
    int passing_ = 0;
    int words_px_ = 28, key_px_ = 20, gap_px_ = 24;
};

}  // namespace tacto::gui
