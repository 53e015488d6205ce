// StripCaption.h - the line above a strip: what it shows and in which unit, then the name of each thing drawn in it, in
// its colour.
//
// Laid out when a word changes, not for every picture: shaping these few words sixty times a second cost more than
// drawing the traces they name.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStaticText>
#include <qcustomplot.h>
#include <vector>

namespace tacto::gui {

class StripCaption final : public QCPAbstractItem {
    Q_OBJECT
public:
    /// Owned by the plot of `below`, as every item is.
    explicit StripCaption(QCPAxisRect& below);
    void setFont(const QFont& font);
    [[nodiscard]] const QFont& font() const { return font_; }
    /// Word 0 comes first; an empty one takes no room.
    void setWord(std::size_t index, const QString& text);
    void setColour(std::size_t index, const QColor& colour);

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }

protected:
    void draw(QCPPainter* painter) override;

private:
    struct Word {
        QStaticText text;
        QColor colour;
        double width = 0;
    };
    [[nodiscard]] Word& word(std::size_t index);
    void layOut(Word& word) const;
    QCPAxisRect& below_;
    QFont font_;
    std::vector<Word> words_;
};

}  // namespace tacto::gui
