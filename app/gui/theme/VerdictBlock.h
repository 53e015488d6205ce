// VerdictBlock.h - a verdict in word, shape and colour: filled, to be read across a room, or as a word in a list.
//
// FAIL is white on ink with a cross, never red: red is for STOP and faults.
#pragma once

#include <QColor>
#include <QLabel>

namespace tacto::gui {

struct VerdictStyle {
    QString shape;  ///< the shape as text: "✔"
    QString icon;   ///< "verdict-pass"
    QString word;   ///< "PASS"
    QColor fill;
    QColor ink;     ///< colour of the words on the fill
    QColor colour;  ///< the word's colour in a list
};
/// `key` as RunResult::verdict(), as nameOf(RowVerdict), or "error".
[[nodiscard]] VerdictStyle verdictStyle(const QString& key);
/// "✔ pass", as it stands in a table.
[[nodiscard]] QString verdictText(const QString& key);

class VerdictBlock final : public QLabel {
    Q_OBJECT
public:
    explicit VerdictBlock(QWidget* parent);
    void setVerdict(const QString& key);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString key_;
};

}  // namespace tacto::gui
