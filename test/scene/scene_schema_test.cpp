#include "forming_sim/scene/schema.h"

#include <fstream>
#include <sstream>

#include "forming_sim/scene/validate.h"
#include "scene/scene_texts.h"

namespace forming_sim {
namespace {

TEST(SceneSchema, DocumentIsTheGeneratedOne) {
  std::ifstream file(FORMING_SIM_SOURCE_DIR "/docs/scene.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == schema_markdown()) << "docs/scene.md is old: forming_offline --schema markdown > docs/scene.md";
}

TEST(SceneSchema, ExamplesAreValid) {
  for (const std::string& text : {minimal_example(), flange_example()}) {
    const auto faults = validate(scene_of(text));
    EXPECT_TRUE(faults.empty()) << sentences(faults);
    EXPECT_NE(schema_markdown().find(text), std::string::npos) << "the document shows the example";
  }
}

TEST(SceneSchema, TellsEveryGroupAndField) {
  const auto groups = schema();
  EXPECT_EQ(groups.size(), 29u);
  std::size_t fields = 0;
  for (const GroupText& group : groups) {
    for (const FieldText& field : group.fields) {
      ++fields;
      EXPECT_NE(schema_text().find(field.name + ": " + field.type), std::string::npos) << field.name;
      EXPECT_NE(schema_markdown().find("| `" + field.name + "` | " + field.type), std::string::npos) << field.name;
    }
  }
  EXPECT_GT(fields, 100u);
}

TEST(SceneSchema, OneFieldInFull) {
  EXPECT_NE(schema_markdown().find("| `density` | number | kg/m3 | above 0 and at most 100000 | **required** | always | mass density |"),
            std::string::npos);
  EXPECT_NE(schema_markdown().find("| `width` | number | m | above 0 | **required** | where shape is plate | width along y |"), std::string::npos);
  EXPECT_NE(schema_markdown().find("### bodies[].mesh, tools[].mesh\n"), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
