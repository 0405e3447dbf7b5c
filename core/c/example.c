/* A hundred lamps and a panel from C: they move, one goes, and samples are printed as words, which are those of Rust. */
#include "lightbvh.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LAMPS 100
#define PANEL 200
#define POINTS 1000

/* Ends the program where a call fails. */
static void must(lightbvh_status status)
{
    if (status != LIGHTBVH_OK) {
        fprintf(stderr, "lightbvh: status %d: %s\n", (int)status, lightbvh_last_error());
        exit(1);
    }
}

static uint32_t bits(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static lightbvh_transform at(float x, float y, float z)
{
    lightbvh_transform transform = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {x, y, z}};
    return transform;
}

/* A row of triangles, in another order for each frame. */
static void arrange(lightbvh_triangle *panel, const lightbvh_triangle *lamp, int frame)
{
    int k, vertex;
    for (k = 0; k < PANEL; k++) {
        panel[k] = *lamp;
        for (vertex = 0; vertex < 3; vertex++) {
            panel[k].p[vertex][0] += 0.5f * (float)(k * frame % 199);
        }
    }
}

int main(void)
{
    /* 5 cm^2 that shine down with 900 W/(m^2 sr). */
    const lightbvh_triangle lamp = {
        {{0, 3, 0}, {0.03125f, 3, 0}, {0, 3, 0.03125f}}, {900, 900, 900}, 0, 0};
    lightbvh *bvh = lightbvh_create();
    lightbvh_mesh mesh;
    lightbvh_instance gone, lamps[LAMPS];
    lightbvh_transform place, places[LAMPS];
    uint32_t first, lights;
    lightbvh_triangle larger = lamp, panel[PANEL];
    lightbvh_point points[POINTS];
    lightbvh_sample samples[POINTS];
    uint64_t randoms[POINTS];
    lightbvh_rebuilder *rebuilder = lightbvh_rebuilder_create(1);
    lightbvh_frame_start start;
    lightbvh_range removed[4];
    size_t count;
    unsigned trees = 0;
    static const float white[3] = {1, 1, 1}, warm[3] = {0.5f, 0.25f, 0.125f}, dim[3] = {0.25f, 0.25f, 0.25f};
    int k, frame;

    if (bvh == NULL || rebuilder == NULL) {
        fprintf(stderr, "lightbvh: %s\n", lightbvh_last_error());
        return 1;
    }
    must(lightbvh_add_mesh(bvh, &lamp, 1, &mesh));
    for (k = 0; k < LAMPS - 1; k++) {
        places[k] = at((float)k, 0, 0);
    }
    must(lightbvh_add_instances(bvh, mesh, places, white, LAMPS - 1, lamps));
    place = at((float)k, 0, 0);
    must(lightbvh_add_instances(bvh, mesh, &place, white, 1, &lamps[k]));
    must(lightbvh_refit(bvh));

    /* A frame later: one lamp rises, one gets dimmer and warmer, one goes, and all of them grow. */
    place = at(40, 2, 0);
    must(lightbvh_set_transform(bvh, lamps[40], &place));
    must(lightbvh_set_radiance(bvh, lamps[41], warm));
    gone = lamps[42];
    must(lightbvh_remove_instance(bvh, gone));
    larger.p[1][0] = 0.0625f;
    must(lightbvh_set_triangle_range(bvh, mesh, 0, &larger, 1));
    must(lightbvh_refit(bvh));

    /* What was kept of the light that went is replaced; then its number may be another's. */
    must(lightbvh_removed_lights(bvh, removed, 4, &count));
    for (k = 0; k < (int)count && k < 4; k++) {
        printf("%u lights from %u on are no more\n", (unsigned)removed[k].count, (unsigned)removed[k].first);
    }
    must(lightbvh_forget_removed_lights(bvh));

    /* The triangles of a panel change places in each frame, so its tree is rebuilt in the background. If runs need not be
     * bit-identical, lightbvh_rebuilder_create(0) keeps frames from waiting. */
    arrange(panel, &lamp, 1);
    must(lightbvh_add_mesh(bvh, panel, PANEL, &mesh));
    place = at(0, 1, 4);
    must(lightbvh_add_instances(bvh, mesh, &place, dim, 1, &lamps[42]));
    for (frame = 1; frame <= 30; frame++) {
        must(lightbvh_begin_frame(rebuilder, bvh, &start));
        trees += start.swapped + start.meshes;
        arrange(panel, &lamp, frame);
        must(lightbvh_set_triangle_range(bvh, mesh, 0, panel, PANEL));
        must(lightbvh_refit(bvh));
        must(lightbvh_end_frame(rebuilder, bvh));
    }
    printf("%u trees were built\n", trees);

    must(lightbvh_lights_of(bvh, lamps[40], &first, &lights));
    printf("lamp 40 has lights from %u on, %u of them\n", (unsigned)first, (unsigned)lights);

    /* Samples of a row of points on the ground, as words. */
    for (k = 0; k < POINTS; k++) {
        lightbvh_point point = {{0.125f * (float)k, 0, 0.5f}, {0, 1, 0}};
        points[k] = point;
        randoms[k] = UINT64_C(0x9e3779b97f4a7c15) * (uint64_t)(k + 1);
    }
    must(lightbvh_sample_batch(bvh, points, randoms, POINTS, samples));
    for (k = 0; k < POINTS; k++) {
        lightbvh_sample one;
        lightbvh_light_point on;
        float pmf;
        must(lightbvh_sample_light(bvh, &points[k], randoms[k], &one));
        must(lightbvh_pmf(bvh, &points[k], one.light, one.instance, &pmf));
        must(lightbvh_point_of(bvh, one.light, one.instance, 0.25f, 0.5f, &on));
        if (memcmp(&one, &samples[k], sizeof one) != 0 || bits(pmf) != bits(one.pmf)) {
            fprintf(stderr, "point %d: batch, sample and pmf differ\n", k);
            return 1;
        }
        printf("%" PRIu32 " %" PRIu32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 "\n", one.light, one.instance,
               bits(one.pmf), bits(on.p[0]), bits(on.density));
    }

    /* What is wrong is refused, with a sentence. */
    if (lightbvh_set_radiance(bvh, gone, white) != LIGHTBVH_REFUSED ||
        lightbvh_remove_mesh(bvh, mesh) != LIGHTBVH_REFUSED) {
        fprintf(stderr, "a wrong edit was done\n");
        return 1;
    }
    printf("%s\n", lightbvh_last_error());
    lightbvh_rebuilder_free(rebuilder);
    lightbvh_free(bvh);
    return 0;
}
