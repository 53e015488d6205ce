// ArmQuestion.h - asks before the bench that is open is armed or its impedance is checked, and keeps the load that was
// declared last for the next time.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QObject>
#include <filesystem>

#include "app/gui/controller/BenchController.h"
#include "app/gui/window/ArmDialog.h"

namespace tacto::gui {

class ArmQuestion final : public QObject {
    Q_OBJECT
public:
    ArmQuestion(BenchController& controller, QWidget& window);
    /// The first of the two steps. With another bench or profile the question is void.
    void ask(ArmDialog::Purpose purpose);

signals:
    /// There is nothing to arm or to check: a sentence with what to do.
    void refused(const QString& why);

private:
    void noteBench();

    BenchController& controller_;
    QWidget& window_;
    QString load_;                  ///< declared last, or known of a simulated bench
    std::filesystem::path loadOf_;  ///< the session of its bench
};

}  // namespace tacto::gui
