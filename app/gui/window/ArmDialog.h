// ArmDialog.h - the second step of arming: what will be connected, what the limits will be held against, and a button
// that is not the default one (hazard H6).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include "app/gui/desk/BenchDesk.h"

namespace tacto::gui {

class ArmDialog final : public QDialog {
    Q_OBJECT
public:
    ArmDialog(BenchDesk& desk, const QString& load, QWidget* parent);
    /// The declared load, as written.
    [[nodiscard]] QString load() const { return load_->text(); }

private:
    void judge();
    void arm();

    BenchDesk& desk_;
    QLineEdit* load_;
    QLabel* trouble_;
    QCheckBox* connected_;
    QPushButton* arm_;
    bool readsBack_ = true;
};

}  // namespace tacto::gui
