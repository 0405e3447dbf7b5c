// 2,000 moving points and spots with masks, ranges and colours on the program's own Vulkan devices: the self-test; in
// each frame edits, a refit, its steps, and samples; every word is compared with the CPU's. Exit code 1 if one differs.
#include "lightbvh.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>
#include <vulkan/vulkan.h>

namespace {
const uint32_t MODEL = LIGHTBVH_MASKED_LIGHTS, LIGHTS = 2000, POINTS = 4096, FRAMES = 20, SETS = 256;
const VkDescriptorType STORAGE = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
[[noreturn]] void fail(const char *what) { std::fprintf(stderr, "%s\n", what), std::exit(1); }
void must(lightbvh_status status) { if (status != LIGHTBVH_OK) fail(lightbvh_last_error()); }
void must(VkResult result) { if (result != VK_SUCCESS) fail("a Vulkan call failed"); }

// Host-visible for brevity: an engine's buffers are the device's own, and uploads are copies.
struct Buffer { VkBuffer raw; VkDeviceMemory memory; char *at; uint64_t bytes; };

// An open device, its buffers by lightbvh_buffer, and its kernels by lightbvh_kernel_id, which share a layout.
struct Gpu {
    VkDevice device; VkQueue queue; VkCommandBuffer commands; VkDescriptorPool sets;
    VkDescriptorSetLayout bindings; VkPipelineLayout layout; VkPhysicalDeviceMemoryProperties memory;
    Buffer buffers[LIGHTBVH_ANSWERS + 1];
    lightbvh_kernel kernels[LIGHTBVH_SELF_TEST + 1]; VkPipeline pipelines[LIGHTBVH_SELF_TEST + 1];

    void open(VkPhysicalDevice physical, uint32_t controls) {
        vkGetPhysicalDeviceMemoryProperties(physical, &memory);
        VkQueueFamilyProperties families[32];
        uint32_t family = 0, count = 32;
        vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
        while (!(families[family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++family;
        const float priority = 1;
        VkDeviceQueueCreateInfo one{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
        VkPhysicalDeviceVulkan12Features wanted{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
        wanted.vulkanMemoryModel = VK_TRUE;
        VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted, 0, 1, &one};
        must(vkCreateDevice(physical, &info, nullptr, &device));
        vkGetDeviceQueue(device, family, 0, &queue);
        VkCommandPool pool; const uint32_t reset = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        VkCommandPoolCreateInfo own{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, reset, family};
        must(vkCreateCommandPool(device, &own, nullptr, &pool));
        VkCommandBufferAllocateInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool, {}, 1};
        must(vkAllocateCommandBuffers(device, &buffer, &commands));
        VkDescriptorPoolSize size{STORAGE, 6 * SETS};
        VkDescriptorPoolCreateInfo many{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, SETS, 1, &size};
        must(vkCreateDescriptorPool(device, &many, nullptr, &sets));
        VkDescriptorSetLayoutBinding each[6];
        for (uint32_t k = 0; k < 6; ++k) each[k] = {k, STORAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
        VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, 6, each};
        must(vkCreateDescriptorSetLayout(device, &set, nullptr, &bindings));
        VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(lightbvh_frame::push)};
        VkPipelineLayoutCreateInfo all{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, {}, 0, 1, &bindings, 1, &push};
        must(vkCreatePipelineLayout(device, &all, nullptr, &layout));
        for (uint32_t which = 0; which <= LIGHTBVH_SELF_TEST; ++which) load(which, controls);
    }
    void load(uint32_t which, uint32_t controls) {
        size_t count = 0; must(lightbvh_kernel_of(MODEL, which, &kernels[which]));
        must(lightbvh_kernel_words(MODEL, which, controls, nullptr, 0, &count));
        std::vector<uint32_t> words(count);
        must(lightbvh_kernel_words(MODEL, which, controls, words.data(), count, &count));
        VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, 4 * count, words.data()};
        VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        info.layout = layout, info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT, info.stage.pName = kernels[which].name;
        must(vkCreateShaderModule(device, &code, nullptr, &info.stage.module));
        must(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipelines[which]));
    }
    void resize(uint32_t which, uint64_t bytes) {
        Buffer &own = buffers[which];
        vkDestroyBuffer(device, own.raw, nullptr), vkFreeMemory(device, own.memory, nullptr), own.bytes = bytes;
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, {}, 0, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
        must(vkCreateBuffer(device, &info, nullptr, &own.raw));
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device, own.raw, &needs);
        uint32_t type = 0, host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        while (!(needs.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & host) != host) ++type;
        VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
        must(vkAllocateMemory(device, &allocate, nullptr, &own.memory));
        must(vkBindBufferMemory(device, own.raw, own.memory, 0));
        must(vkMapMemory(device, own.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void **>(&own.at)));
    }
    // What follows sees what it wrote.
    void dispatch(uint32_t which, const uint32_t *push, uint32_t count) {
        VkDescriptorSet set;
        VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, sets, 1, &bindings};
        must(vkAllocateDescriptorSets(device, &info, &set));
        for (uint32_t k = 0; k < kernels[which].binding_count; ++k) {
            VkDescriptorBufferInfo buffer{buffers[kernels[which].bindings[k].buffer].raw, 0, VK_WHOLE_SIZE};
            VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, {}, set, k, 0, 1, STORAGE, {}, &buffer};
            vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
        }
        uint32_t groups[3]; must(lightbvh_groups(count, groups));
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines[which]);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, kernels[which].push_bytes, push);
        vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
        const uint32_t all = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
        VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, {}, VK_ACCESS_SHADER_WRITE_BIT, all};
        const uint32_t from = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, to = from | VK_PIPELINE_STAGE_HOST_BIT;
        vkCmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    }
    template <class Record> void run(Record record) {
        VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO, {}, 0, {}, {}, 1, &commands};
        must(vkResetDescriptorPool(device, sets, 0)), must(vkBeginCommandBuffer(commands, &info)), record();
        must(vkEndCommandBuffer(commands)), must(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
        must(vkQueueWaitIdle(queue));
    }
};

// Does it calculate as the CPU does? Operands are less than 4,096 bytes.
void self_test(Gpu &gpu) {
    const uint32_t push = 128; size_t count = 0;
    gpu.resize(LIGHTBVH_OPERANDS, 4096), gpu.resize(LIGHTBVH_ANSWERS, LIGHTBVH_ANSWERS_BYTES);
    must(lightbvh_self_test_operands(reinterpret_cast<uint32_t *>(gpu.buffers[LIGHTBVH_OPERANDS].at), 1024, &count));
    gpu.run([&] { gpu.dispatch(LIGHTBVH_SELF_TEST, &push, push); });
    must(lightbvh_self_test_check(gpu.buffers[LIGHTBVH_ANSWERS].at, LIGHTBVH_ANSWERS_BYTES));
}

uint32_t state;
uint32_t bits() { return state = state * 1664525u + 1013904223u, state ^ state >> 16; }
float unit() { return float(bits() >> 8) / 16777216.0f; }

// An edit of a light, at first one that adds it: a point or a spot that looks down, anywhere over a field of 200 m.
lightbvh_edit change(lightbvh_light &light, lightbvh_id id, bool is_first) {
    const uint32_t kinds[] = {LIGHTBVH_SET_LIGHT, LIGHTBVH_SET_MASK, LIGHTBVH_SET_RADIANCE, LIGHTBVH_SET_TRANSFORM};
    light = {bits() % 2 ? LIGHTBVH_POINT : LIGHTBVH_SPOT, 0, {200 * unit(), 3 + unit(), 200 * unit()}, {0, -1, 0}, {},
             {20 * unit(), 20, 20 * unit()}, 0, bits() % 2 ? 15.0f : 25.0f, 0.3f, 0.8f};
    lightbvh_edit own = lightbvh_edit_of(is_first ? LIGHTBVH_ADD_LIGHT : kinds[bits() % 4]);
    own.id = id, own.lights = &light, own.radiance[1] = unit(), own.mask = 1u << bits() % 4;
    return own.transform.translation[0] = unit(), own.transform.translation[2] = unit(), own;
}

// All frames on one device; returns how many words were compared.
uint64_t frames(Gpu &gpu) {
    uint64_t words = 0, compared = 0, different = state = 0;
    lightbvh *bvh = lightbvh_create(MODEL); lightbvh_mirror *mirror = lightbvh_mirror_create(MODEL);
    std::vector<lightbvh_id> ids(LIGHTS);
    gpu.resize(LIGHTBVH_QUERIES, POINTS * sizeof(lightbvh_masked_query));
    gpu.resize(LIGHTBVH_RESULTS, POINTS * sizeof(lightbvh_sampled_light));
    for (uint32_t frame = 0; frame < FRAMES; ++frame) {
        std::vector<lightbvh_light> lights(LIGHTS); std::vector<lightbvh_edit> edits;
        for (uint32_t k = 0; k < LIGHTS; ++k) // One in eight changes.
            if (frame == 0 || bits() % 8 == 0) edits.push_back(change(lights[k], ids[k], frame == 0));
        must(lightbvh_apply(bvh, edits.data(), edits.size(), frame ? nullptr : ids.data(), nullptr));
        must(lightbvh_refit(bvh));
        std::vector<lightbvh_point> points(POINTS); std::vector<uint64_t> randoms(POINTS);
        auto *queries = reinterpret_cast<lightbvh_masked_query *>(gpu.buffers[LIGHTBVH_QUERIES].at);
        for (uint32_t k = 0; k < POINTS; ++k) {
            points[k] = {{200 * unit(), 0, 200 * unit()}, {0, 1, 0}, 1u << bits() % 4};
            queries[k] = {points[k], {bits(), bits()}};
            randoms[k] = uint64_t(queries[k].words[0]) << 32 | queries[k].words[1];
        }
        lightbvh_frame work; must(lightbvh_mirror_frame(mirror, bvh, &work));
        gpu.run([&] {
            for (const lightbvh_step *step = work.steps; step != work.steps + work.count; ++step) {
                Buffer &buffer = gpu.buffers[step->which];
                if (step->kind == LIGHTBVH_RESIZE) gpu.resize(step->which, step->bytes);
                if (step->kind == LIGHTBVH_UPLOAD) std::memcpy(buffer.at + step->at, step->data, step->bytes);
                if (step->kind == LIGHTBVH_DISPATCH) gpu.dispatch(step->which, step->push, step->count);
            }
            work.push[0] = POINTS;
            gpu.dispatch(LIGHTBVH_SAMPLE, work.push, POINTS);
        });
        std::vector<lightbvh_sampled_light> samples(POINTS);
        must(lightbvh_sample_batch(bvh, points.data(), randoms.data(), POINTS, samples.data()));
        const Buffer *held = gpu.buffers, &results = held[LIGHTBVH_RESULTS];
        if (std::memcmp(samples.data(), results.at, results.bytes)) fail("samples differ");
        words += results.bytes / 4;
        for (uint32_t k = LIGHTBVH_NODES; k <= LIGHTBVH_TRAILS; ++k, words += compared) {
            must(lightbvh_mirror_compare(mirror, bvh, k, held[k].at, held[k].bytes, &compared, &different));
            if (different > 0) fail("words of a buffer differ");
        }
    }
    return lightbvh_mirror_free(mirror), lightbvh_free(bvh), words;
}
} // namespace

int main() {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO, {}, "lights", 0, {}, 0, VK_API_VERSION_1_2};
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, &application};
    VkInstance instance; VkPhysicalDevice all[16]; uint32_t count = 16, devices = 0;
    must(vkCreateInstance(&info, nullptr, &instance));
    vkEnumeratePhysicalDevices(instance, &count, all);
    for (uint32_t k = 0; k < count; ++k) {
        VkPhysicalDeviceFloatControlsProperties floats{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES};
        VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &floats, {}};
        VkPhysicalDeviceVulkan12Features vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
        VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &vulkan12, {}};
        vkGetPhysicalDeviceProperties2(all[k], &properties), vkGetPhysicalDeviceFeatures2(all[k], &features);
        if (properties.properties.apiVersion < VK_API_VERSION_1_2 || !vulkan12.vulkanMemoryModel) continue;
        const VkBool32 keeps = floats.shaderSignedZeroInfNanPreserveFloat32, even = floats.shaderRoundingModeRTEFloat32;
        Gpu gpu{};
        gpu.open(all[k], LIGHTBVH_PRESERVES_ZERO_INF_NAN * keeps | LIGHTBVH_ROUNDS_TO_EVEN * even), self_test(gpu);
        std::printf("%s: %u words are the CPU's\n", properties.properties.deviceName, unsigned(frames(gpu))), ++devices;
    }
    if (devices == 0) fail("no Vulkan 1.2 device with vulkanMemoryModel");
}
