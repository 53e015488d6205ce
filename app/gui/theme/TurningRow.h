// TurningRow.h - parts beside each other where there is room, else one below the other.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QBoxLayout>
#include <functional>

namespace tacto::gui {

class TurningRow final : public QBoxLayout {
    Q_OBJECT
public:
    /// `from`: the width from which its parts stand beside each other, asked whenever it is laid out: it may follow the
    /// size of text. Without it: as wide as its parts like to be.
    explicit TurningRow(std::function<int()> from = {}, QWidget* parent = nullptr)
        : QBoxLayout(LeftToRight, parent), from_(std::move(from)) {}
    void setGeometry(const QRect& room) override;
    /// From where its parts stand beside each other, whichever way they stand now.
    [[nodiscard]] QSize sizeHint() const override;
    /// As wide as its widest part, whichever way it stands: it can always turn.
    [[nodiscard]] QSize minimumSize() const override;

signals:
    /// It stands the other way now.
    void turned(bool beside);

private:
    [[nodiscard]] int from() const;
    std::function<int()> from_;
};

}  // namespace tacto::gui
