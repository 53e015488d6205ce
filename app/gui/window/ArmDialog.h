// ArmDialog.h - the second step of arming, and of checking the impedance: what will be connected, what the limits will
// be held against, the text that the operator confirms, and a button that is not the default one (hazards H6, H12). It
// closes when a stop comes and after 30 s.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class ArmDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Arm, CheckImpedance };
    ArmDialog(BenchController& controller, Purpose purpose, const QString& load, QWidget* parent);
    /// The declared load, as written.
    [[nodiscard]] QString load() const { return load_->text(); }

private:
    void addPurpose(QVBoxLayout& layout);
    void addLoad(QVBoxLayout& layout, const QString& load);
    void addWhatIsArmed(QVBoxLayout& layout);
    QPushButton* addButtons(QVBoxLayout& layout);
    void judge();
    void confirm();
    void sayFirst();

    BenchController& controller_;
    const Purpose purpose_;
    const StopMark asked_;  // when the operator took the first step
    std::string text_;      // as it stands in confirmed_
    QLineEdit* load_;
    QLabel* confirmed_;
    QLabel* first_;  ///< what follows as soon as the output is armed
    QLabel* trouble_;
    QCheckBox* connected_;
    QPushButton* arm_;
    bool readsBack_ = true;
    bool massager_ = false;  // has no load
};

}  // namespace tacto::gui
