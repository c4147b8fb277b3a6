/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the four environment modes do what their names say: none shows the clay's colour, opaque hides it, a constant
 *       layer lies over it evenly, a clear coat grows towards grazing angles by Schlick's formula.
 * Method: black, red and blue balls under no light, so that whatever is seen is the environment; the angle at each
 *         pixel comes from the ray that meets the ball. */
#include "view_stage.h"

namespace {

constexpr double radius = 24;
constexpr uint32_t black = view_stage_rgba(0, 0, 0);
constexpr uint32_t red = view_stage_rgba(230, 40, 40);
constexpr uint32_t blue = view_stage_rgba(40, 40, 230);

class view_environment : public view_stage {
  protected:
    view_stage_picture draw_ball(const snapshot &s, uint32_t rgba)
    {
        view_stage_piece piece;
        piece.ball({0, 0, 0}, radius, rgba);
        return draw_fresh(s, piece);
    }

    /* Cosine between the ball's normal and the direction to the eye where the pixel's ray meets it; 0 beside it. */
    static double facing(const snapshot &s, int x, int y)
    {
        const double dx = (x + 0.5 - width / 2.0) / focal_pixels(s), dy = (height / 2.0 - y - 0.5) / focal_pixels(s);
        const double length = std::sqrt(dx * dx + dy * dy + 1);
        const double along = s.camera_distance / length; /* to the point nearest the middle */
        const double aside = s.camera_distance * s.camera_distance - along * along;
        return aside >= radius * radius ? 0 : std::sqrt(1 - aside / (radius * radius));
    }
};

TEST_F(view_environment, none_shows_the_clay_and_opaque_hides_it)
{
    snapshot s = plain();
    const view_stage_picture none_red = draw_ball(s, red), none_blue = draw_ball(s, blue);
    EXPECT_GT(none_red.linear(width / 2, height / 2, 0), 3 * none_red.linear(width / 2, height / 2, 2));
    EXPECT_GT(none_blue.linear(width / 2, height / 2, 2), 3 * none_blue.linear(width / 2, height / 2, 0));
    s.environment = SNAPSHOT_ENVIRONMENT_OPAQUE;
    const view_stage_picture metal_red = draw_ball(s, red), metal_blue = draw_ball(s, blue);
    EXPECT_EQ(metal_red.apart(metal_blue), 0);
    EXPECT_GT(metal_red.changed(none_red), 1000);
    s.lights = {};
    EXPECT_EQ(draw_ball(s, red).apart(metal_red), 0) << "metal shows the map alone";
}

TEST_F(view_environment, the_map_is_mirrored_as_by_a_ball_of_metal)
{
    snapshot s = ambient();
    s.environment = SNAPSHOT_ENVIRONMENT_OPAQUE;
    const view_stage_picture p = draw_ball(s, black);
    const double pixels = ball_pixels(s, radius);
    auto mean = [&](double x, double y) {
        double sum = 0;
        for (int dy = -2; dy <= 2; dy++)
            for (int dx = -2; dx <= 2; dx++)
                sum += p.light(static_cast<int>(width / 2 + x * pixels) + dx,
                               static_cast<int>(height / 2 - y * pixels) + dy);
        return sum / 25;
    };
    /* the key soft box stands up left of the camera: normal half way between (0,0,1) and it */
    EXPECT_GT(mean(-0.33, 0.33), 0.8);
    EXPECT_LT(mean(0, -0.6), 0.3) << "the floor is dark";
    EXPECT_GT(mean(-0.33, 0.33), 3 * mean(0.33, 0.33)) << "left and right are not swapped";
}

TEST_F(view_environment, semi_transparent_is_an_even_layer)
{
    snapshot s = ambient();
    s.environment = SNAPSHOT_ENVIRONMENT_OPAQUE;
    const view_stage_picture metal = draw_ball(s, black);
    s.environment = SNAPSHOT_ENVIRONMENT_SEMI;
    for (float strength : {0.0f, 0.25f, 0.5f, 1.0f}) {
        s.environment_strength = strength;
        const view_stage_picture p = draw_ball(s, black);
        int looked = 0;
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                if (facing(s, x, y) < 0.3 || metal.linear(x, y, 1) > 0.5)
                    continue; /* beside the ball, or where highlights are bent */
                looked++;
                ASSERT_NEAR(p.linear(x, y, 1), double{strength} * metal.linear(x, y, 1), 0.006) << x << ", " << y;
            }
        }
        EXPECT_GT(looked, 1000);
    }
}

TEST_F(view_environment, clear_coat_follows_schlick)
{
    snapshot s = ambient();
    s.environment = SNAPSHOT_ENVIRONMENT_OPAQUE;
    const view_stage_picture metal = draw_ball(s, black);
    s.environment = SNAPSHOT_ENVIRONMENT_CLEARCOAT;
    const view_stage_picture coat = draw_ball(s, black);
    double centre = 0, rim = 0;
    int looked = 0, centre_count = 0, rim_count = 0;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const double c = facing(s, x, y), whole = metal.linear(x, y, 1);
            if (c < 0.25 || whole > 0.5 || whole < 0.1)
                continue;
            const double weight = coat.linear(x, y, 1) / whole;
            const double schlick = 0.04 + 0.96 * std::pow(1 - c, 5);
            ASSERT_NEAR(weight, schlick, 0.012 + 0.12 * schlick) << x << ", " << y << " facing " << c;
            looked++;
            (c > 0.9 ? centre : rim) += c > 0.9 || c < 0.4 ? weight : 0;
            centre_count += c > 0.9;
            rim_count += c < 0.4;
        }
    }
    EXPECT_GT(looked, 1000);
    ASSERT_GT(centre_count, 100);
    ASSERT_GT(rim_count, 50);
    EXPECT_GT(rim / rim_count, 2.5 * centre / centre_count);
}

TEST_F(view_environment, the_clays_colour_shows_through_a_clear_coat)
{
    snapshot s = ambient();
    const view_stage_picture bare = draw_ball(s, red);
    s.environment = SNAPSHOT_ENVIRONMENT_CLEARCOAT;
    const view_stage_picture coated = draw_ball(s, red);
    EXPECT_NEAR(coated.linear(width / 2, height / 2, 0), bare.linear(width / 2, height / 2, 0), 0.04);
    EXPECT_GT(coated.changed(bare), 1000);
}

} // namespace
