// VerdictBlock.h - a verdict as word, shape and colour: filled and readable across a room, or as a word in a list.
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
    QColor ink;     ///< text colour on the fill
    QColor colour;  ///< text colour in a list
};
/// `key`: from RunResult::verdict() or nameOf(RowVerdict), or "error".
[[nodiscard]] VerdictStyle verdictStyle(const QString& key);
/// Returns the text for a table: "✔ pass".
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
