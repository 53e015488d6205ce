// The form of a protocol's parameters.
#include <gtest/gtest.h>

#include "app/gui/runner/ParameterForm.h"

namespace tacto::test {
namespace {

/// The form shows less of it than the script wrote, and what it shows reads as another value.
TEST(ParameterForm, ADefaultThatWasLeftAloneIsTheScriptsWordToTheLastDigitAndBlank) {
    RecordProperty("hazard", "H9");
    ProtocolDeclaration declaration;
    ProtocolParameter area;
    area.name = area.label = "area";
    area.value = 4.00000000001;
    ProtocolParameter file;
    file.name = file.label = "file";
    file.type = ParameterType::File;
    file.value = "/some/path ";
    declaration.parameters = {area, file};
    gui::ParameterForm form;
    form.show(declaration);
    const auto untouched = form.read().value();
    EXPECT_TRUE(untouched.given.empty());
    EXPECT_EQ(untouched.parameters.at("area"), area.value);
    EXPECT_EQ(untouched.parameters.at("file"), file.value);
    form.set("area", "5");
    form.set("file", "/another");
    const auto chosen = form.read().value();
    EXPECT_EQ(chosen.given, (std::set<std::string>{"area", "file"}));
    EXPECT_EQ(chosen.parameters.at("area"), 5);
}

}  // namespace
}  // namespace tacto::test
