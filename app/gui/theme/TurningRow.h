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
    /// size of text.
    explicit TurningRow(std::function<int()> from, QWidget* parent = nullptr)
        : QBoxLayout(LeftToRight, parent), from_(std::move(from)) {}
    void setGeometry(const QRect& room) override;

signals:
    /// It stands the other way now.
    void turned(bool beside);

private:
    std::function<int()> from_;
};

}  // namespace tacto::gui
