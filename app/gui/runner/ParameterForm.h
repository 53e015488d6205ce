// ParameterForm.h - a protocol's parameters as a form: labels, units and ranges as the script declares them.
//
// Every field is text checked by the same rules as the command line; a refusal stands below its field.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QWidget>
#include <functional>

#include "app/scripting/ProtocolDeclaration.h"

namespace tacto::gui {

class ParameterForm final : public QWidget {
    Q_OBJECT
public:
    explicit ParameterForm(QWidget* parent = nullptr);
    void show(const ProtocolDeclaration& declaration);
    /// Errors: of the first field that is refused; all refusals are shown.
    [[nodiscard]] Result<ProtocolSettings> read();
    /// The text of a parameter as it stands; empty for none of that name.
    [[nodiscard]] QString text(const std::string& name) const;
    /// Writes into a field, as if it were typed; a name or a choice that is not there is left alone.
    void set(const std::string& name, const QString& text);
    /// How many fields are refused as they stand.
    [[nodiscard]] int refused() const { return refused_; }
    /// The first refused field gets the focus.
    void goToRefused();

signals:
    void edited();

private:
    struct Field {
        ProtocolParameter parameter;
        std::function<QString()> text;
        std::function<void(const QString&)> write;
        QWidget* editor = nullptr;
        QLabel* trouble = nullptr;
    };
    [[nodiscard]] Field makeField(const ProtocolParameter& parameter);
    void judge();
    ProtocolDeclaration declaration_;
    std::vector<Field> fields_;
    int refused_ = 0;
};

}  // namespace tacto::gui
