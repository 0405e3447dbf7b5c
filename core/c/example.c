/* A hundred lamps from C: they move, one goes, and samples are printed as words, which are those of Rust. */
#include "lightbvh.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LAMPS 100
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

int main(void)
{
    /* 5 cm^2 that shine down with 900 W/(m^2 sr). */
    const lightbvh_triangle lamp = {
        {{0, 3, 0}, {0.03125f, 3, 0}, {0, 3, 0.03125f}}, {900, 900, 900}, 0, 0};
    lightbvh *bvh = lightbvh_create();
    lightbvh_mesh mesh;
    lightbvh_instance lamps[LAMPS];
    lightbvh_transform place, places[LAMPS];
    uint32_t first, lights;
    lightbvh_triangle larger = lamp;
    lightbvh_point points[POINTS];
    lightbvh_sample samples[POINTS];
    uint64_t randoms[POINTS];
    size_t count;
    int k;

    if (bvh == NULL) {
        fprintf(stderr, "lightbvh: %s\n", lightbvh_last_error());
        return 1;
    }
    must(lightbvh_add_mesh(bvh, &lamp, 1, &mesh));
    for (k = 0; k < LAMPS - 1; k++) {
        places[k] = at((float)k, 0, 0);
    }
    must(lightbvh_add_instances(bvh, mesh, places, 1, LAMPS - 1, lamps));
    place = at((float)k, 0, 0);
    must(lightbvh_add_instance(bvh, mesh, &place, 1, &lamps[k]));
    must(lightbvh_refit(bvh));

    /* A frame later: one lamp rises, one is dimmed, one goes, and all of them grow. */
    place = at(40, 2, 0);
    must(lightbvh_set_transform(bvh, lamps[40], &place));
    must(lightbvh_set_radiance(bvh, lamps[41], 0.5f));
    must(lightbvh_remove_instance(bvh, lamps[42]));
    larger.p[1][0] = 0.0625f;
    must(lightbvh_set_triangles(bvh, mesh, &larger, 1));
    must(lightbvh_set_triangle_range(bvh, mesh, 0, &larger, 1));
    must(lightbvh_refit(bvh));
    must(lightbvh_rebuild(bvh));
    must(lightbvh_light_count(bvh, &count));
    must(lightbvh_lights_of(bvh, lamps[40], &first, &lights));
    printf("lights %u to %u are of lamp 40\n", (unsigned)first, (unsigned)(first + lights));
    printf("%u lights\n", (unsigned)count);

    /* Samples of a row of points on the ground, as words. */
    for (k = 0; k < POINTS; k++) {
        lightbvh_point point = {{0.125f * (float)k, 0, 0.5f}, {0, 1, 0}};
        points[k] = point;
        randoms[k] = UINT64_C(0x9e3779b97f4a7c15) * (uint64_t)(k + 1);
    }
    must(lightbvh_sample_batch(bvh, points, randoms, POINTS, samples));
    for (k = 0; k < POINTS; k++) {
        lightbvh_sample one;
        lightbvh_triangle triangle;
        lightbvh_light_point on;
        float pmf;
        must(lightbvh_sample_light(bvh, &points[k], randoms[k], &one));
        must(lightbvh_pmf(bvh, &points[k], one.light, one.instance, &pmf));
        must(lightbvh_triangle_of(bvh, one.light, one.instance, &triangle));
        must(lightbvh_point_of(bvh, one.light, one.instance, 0.25f, 0.5f, &on));
        if (memcmp(&one, &samples[k], sizeof one) != 0 || bits(pmf) != bits(one.pmf)) {
            fprintf(stderr, "point %d: batch, sample and pmf differ\n", k);
            return 1;
        }
        printf("%" PRIu32 " %" PRIu32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 "\n", one.light, one.instance,
               bits(one.pmf), bits(triangle.p[1][0]), bits(on.density));
    }

    /* What is wrong is refused, with a sentence. */
    if (lightbvh_set_radiance(bvh, lamps[42], 1) != LIGHTBVH_REFUSED ||
        lightbvh_remove_mesh(bvh, mesh) != LIGHTBVH_REFUSED) {
        fprintf(stderr, "a wrong edit was done\n");
        return 1;
    }
    printf("%s\n", lightbvh_last_error());
    lightbvh_free(bvh);
    return 0;
}
