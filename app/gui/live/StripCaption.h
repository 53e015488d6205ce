// StripCaption.h - the line above a strip: what it shows and in which unit, a key for each thing drawn in it, and at
// the right the newest value.
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
    /// In the current theme and text size.
    void dress();
    [[nodiscard]] int lineHeight() const;

    void setTitle(const QString& text);
    /// Digits have equal widths, so that the value does not jump. A value that describes the picture is drawn fainter.
    void setValue(const QString& text, bool describes = false);
    [[nodiscard]] QString value() const { return value_.text.text(); }
    /// An empty key takes no room. `brief` stands for it where there is no room for all keys.
    void setKey(std::size_t index, const QString& text, const QString& brief = {});
    /// What is drawn beside the key: a piece of the line, and the mark in its middle.
    void setSample(std::size_t index, const QPen& line, const QCPScatterStyle& mark = QCPScatterStyle::ssNone);

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }

protected:
    void draw(QCPPainter* painter) override;

private:
    struct Words {
        QStaticText text;
        double width = 0;
    };
    struct Key {
        Words words, brief;
        QPen line{Qt::NoPen};
        QCPScatterStyle mark{QCPScatterStyle::ssNone};
    };
    /// How the keys are set: from where, with how much of each.
    struct Setting {
        double from, sample, between;
        bool brief;
    };
    [[nodiscard]] static const Words& wordsOf(const Key& key, bool brief);
    [[nodiscard]] double endOf(const Setting& setting) const;
    [[nodiscard]] Setting settingFor(double title, double until) const;
    [[nodiscard]] Key& key(std::size_t index);
    static void set(Words& words, const QString& text, const QFont& font);
    static void layOut(Words& words, const QFont& font);
    void write(QCPPainter& painter, const Words& words, const QFont& font, double x) const;

    QCPAxisRect& below_;
    QFont font_;
    QFont strong_;
    Words title_;
    Words value_;
    bool describes_ = false;
    std::vector<Key> keys_;
};

}  // namespace tacto::gui
