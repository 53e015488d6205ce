// ParticipantField.h - the middle of the participant's screen: a dot, a name, the two intervals of a detection trial,
// or the targets of a question, always at the same place.
//
// Targets of a question are at least kTarget_mm wide and high, unless the screen has no room for them.
#pragma once

#include <QWidget>
#include <vector>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/pilot/AnswerTarget.h"

class QPainter;

namespace tacto::gui {

constexpr double kTarget_mm = 20;

/// Logical pixels of a length on this screen; of 96 to an inch where the screen does not say its size.
[[nodiscard]] int pixelsOf(double mm, const QWidget& on);

/// The icons beside a condition's words; none for a condition of another name.
[[nodiscard]] QStringList iconsOf(const std::string& key);
/// The number of columns in which so many targets stand, unless they are a scale.
[[nodiscard]] int fieldColumns(int count);

class ParticipantField final : public QWidget {
    Q_OBJECT
public:
    explicit ParticipantField(QWidget* parent);
    void clear();
    void showDot();
    void showWord(const QString& word, const QStringList& icons);
    /// The intervals of a detection trial, where the targets "first" and "second" will stand; `passing` is filled: 1,
    /// 2, or 0 for neither.
    void showIntervals(int passing);
    /// `buttons`: of a pad, written on the targets; fewer than these, or none.
    void showTargets(const PilotPrompt& prompt, const AnswerKeys& keys, const QStringList& buttons = {});
    /// Pixels of words, keys, and between targets.
    void setType(int words_px, int key_px, int gap_px);
    /// Chosen of Several.
    void setChosen(int target, bool chosen);
    [[nodiscard]] bool chosen(int target) const;
    /// Targets of the prompt that is shown, in the order of its keys; with Several the last is "done".
    [[nodiscard]] const std::vector<AnswerTarget*>& targets() const { return targets_; }

signals:
    void chosenAt(int target, tacto::gui::SteadyTime at);
    void missed();  ///< a press beside every target

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
